// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace scarp {

/// The elements of a range as text, each by the same format. A source that calls fmt::join instead compiles all of fmt's
/// formatting anew.
template <class Range>
std::string listed(Range const& range, std::string_view between = ", ", std::string_view each = "{}") {
  std::string text;
  bool first = true;
  for (auto const& element : range) {
    if (!first) text += between;
    first = false;
    text += fmt::vformat(each, fmt::make_format_args(element));
  }
  return text;
}

}  // namespace scarp

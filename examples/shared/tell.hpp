// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace examples {

/// Writes to a stream of which nobody may read: what cannot be told is lost and ends no run.
template <class... Arguments>
void say(std::FILE* stream, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  std::fputs(fmt::format(text, std::forward<Arguments>(arguments)...).c_str(), stream);
  std::fflush(stream);
}

/// What a reader has noticed, on the error stream.
inline void tell(std::vector<std::string> const& notes) {
  for (auto const& note : notes) say(stderr, "note: {}\n", note);
}

}  // namespace examples

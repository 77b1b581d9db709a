// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace examples {

/// Writes to a stream that nobody may read: text that cannot be written is lost and ends no run.
template <class... Arguments>
void print(std::FILE* stream, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  std::fputs(fmt::format(text, std::forward<Arguments>(arguments)...).c_str(), stream);
  std::fflush(stream);
}

/// Notes of a reader, on the error stream.
inline void print_notes(std::vector<std::string> const& notes) {
  for (auto const& note : notes) print(stderr, "note: {}\n", note);
}

}  // namespace examples

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <string_view>

#include "scarp/core/build_info.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/run/resources.hpp"

namespace benchmarks {

/// Of the environment that benchmarks/run sets.
inline std::string environment(char const* name, char const* otherwise) {
  char const* const value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

/// Writes a table of comma-separated values as data file NAME.csv behind a line with command, date, commit, machine,
/// build and `more`, and prints a summary: by default its first twelve rows.
/// \throws FileError when the file cannot be written
inline void write_data(std::string const& name, std::string const& table, std::string const& more = {},
                       std::string summary = {}) {
  std::filesystem::path const folder = environment("SCARP_DATA", ".");
  std::filesystem::create_directories(folder);
  auto const origin =
      fmt::format("# {}; {:%Y-%m-%d}; commit {}; {}; {}{}{}\n", environment("SCARP_COMMAND", "command not stated"),
                  fmt::localtime(std::time(nullptr)), environment("SCARP_COMMIT", "unknown"), scarp::processor(),
                  scarp::described(scarp::build_info()), more.empty() ? "" : "; ", more);
  scarp::write_file(folder / (name + ".csv"), origin + table);
  if (summary.empty()) {
    std::size_t end = 0;
    for (int line = 0; line <= 12 && end < table.size(); ++line)
      end = std::min(table.find('\n', end), table.size()) + 1;
    summary = table.substr(0, end);
  }
  fmt::print("{}\n{}", (folder / (name + ".csv")).string(), summary);
}

/// Whether the only option that is known was given. \throws InputError for others
inline bool is_quick(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    if (std::string_view(argv[k]) != "--quick")
      scarp::reject("option '{}' is not known (there is only --quick): leave it out", argv[k]);
  }
  return argc > 1;
}

}  // namespace benchmarks

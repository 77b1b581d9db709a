// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string>

namespace examples {

/// A file of data that belongs to an example: the one of the wheel that the program lies in (`../examples`), else that
/// of the sources.
/// place: below the folder `examples`; sources: the file that the program was built beside
inline std::filesystem::path data_file(std::string const& place, std::filesystem::path const& sources) {
  std::error_code none;
  auto const program = std::filesystem::read_symlink("/proc/self/exe", none);
  auto const installed = program.parent_path().parent_path() / "examples" / place;
  return std::filesystem::is_regular_file(installed, none) ? installed : sources;
}

}  // namespace examples

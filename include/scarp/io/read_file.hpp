// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "scarp/core/error.hpp"

namespace scarp {

/// The whole content of a file, byte by byte.
/// \throws InputError for a file that is missing, a folder or cannot be read
inline std::string read_file(std::filesystem::path const& path) {
  std::error_code trouble;
  if (!std::filesystem::exists(path, trouble)) {
    refuse("cannot read '{}' (there is no such file): check its name and folder", path.string());
  }
  if (std::filesystem::is_directory(path, trouble)) {
    refuse("cannot read '{}' (it is a folder): give the name of a file", path.string());
  }
  std::string content;
  std::ifstream stream(path, std::ios::binary);
  char block[1 << 16];
  while (stream.read(block, sizeof block) || stream.gcount() > 0) {
    content.append(block, static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.eof()) refuse("cannot read '{}' (the system refuses it): check its permissions", path.string());
  return content;
}

/// Does what may find its input wrong; complaints then begin with `place`, such as a file and a line of it.
template <class Action>
decltype(auto) naming(std::string_view place, Action&& action) {
  try {
    return action();
  } catch (InputError const& error) {
    refuse("{}: {}", place, error.what());
  }
}

}  // namespace scarp

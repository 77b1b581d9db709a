// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "scarp/core/error.hpp"

namespace scarp {

namespace detail {

/// What often lies where a file should be: no format that is read here begins so.
inline void reject_stand_in(std::string_view content, std::string_view file) {
  auto begin = content.substr(0, 256);
  begin.remove_prefix(std::min(begin.find_first_not_of(" \t\r\n"), begin.size()));
  std::string lower;
  for (char const letter : begin.substr(0, 16))
    lower += letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter + 32) : letter;
  if (lower.starts_with("<!doctype html") || lower.starts_with("<html"))
    reject("cannot read '{}' (it is a web page): download the file itself", file);
  if (begin.starts_with("\xFF\xFE") || begin.starts_with("\xFE\xFF"))
    reject("cannot read '{}' (it is text in UTF-16, which spreadsheets call Unicode): save it in UTF-8", file);
  if (begin.starts_with("version https://git-lfs"))
    reject("cannot read '{}' (it is a pointer of Git LFS): fetch the file itself by `git lfs pull`", file);
  if (begin.starts_with("\x1f\x8b") || begin.starts_with("PK\x03\x04") || begin.starts_with("BZh") ||
      begin.starts_with("\xfd"
                        "7zXZ"))
    reject("cannot read '{}' (it is compressed): unpack it", file);
}

}  // namespace detail

/// The whole content of a file, byte by byte.
/// \throws InputError for a file that is missing, a folder or cannot be read, and for a web page, a pointer of Git LFS
/// or an archive
inline std::string read_file(std::filesystem::path const& path) {
  std::error_code trouble;
  if (!std::filesystem::exists(path, trouble)) {
    reject("cannot read '{}' (there is no such file): check its name and folder", path.string());
  }
  if (std::filesystem::is_directory(path, trouble)) {
    reject("cannot read '{}' (it is a folder): give the name of a file", path.string());
  }
  std::string content;
  std::ifstream stream(path, std::ios::binary);
  char block[1 << 16];
  while (stream.read(block, sizeof block) || stream.gcount() > 0) {
    content.append(block, static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.eof()) reject("cannot read '{}' (the system denies it): check its permissions", path.string());
  detail::reject_stand_in(content, path.string());
  return content;
}

/// Runs a task that may reject its input; messages then begin with `place`, such as a file and a line of it.
template <class Action>
decltype(auto) with_context(std::string_view place, Action&& action) {
  try {
    return action();
  } catch (InputError const& error) {
    reject("{}: {}", place, error.what());
  }
}

}  // namespace scarp

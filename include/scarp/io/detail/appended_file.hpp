// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string_view>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/atomic_file.hpp"

namespace scarp {

/// A text file that grows line by line; every line is handed to the operating system at once. A checkpoint remembers how long
/// it was.
class AppendedFile {
 public:
  /// Goes on behind what the file holds.
  /// \throws FileError when it cannot be opened
  explicit AppendedFile(std::filesystem::path path) : path_(std::move(path)) {
    file_ = detail::open_file(path_, "ab");
    bytes_ = std::filesystem::file_size(path_);
  }

  /// \throws FileError when the line cannot be written
  void add(std::string_view line) {
    if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0) {
      detail::throw_not_written(path_, std::strerror(errno));
    }
    bytes_ += line.size();
  }

  SCARP_MEMBERS_EXCEPT((path_, file_), bytes_)

  /// Takes the lines off that came after the checkpoint.
  /// \throws InputError when lines from before it are gone, FileError when the file cannot be cut
  void after_loading() {
    auto const present = std::filesystem::file_size(path_);
    if (present < bytes_) {
      refuse("'{}' has {} bytes (it had {} when the checkpoint was made): bring back the file of that run",
             path_.string(), present, bytes_);
    }
    std::error_code trouble;
    std::filesystem::resize_file(path_, bytes_, trouble);
    if (trouble) detail::throw_not_written(path_, trouble.message());
  }

 private:
  std::filesystem::path path_;
  std::uintmax_t bytes_ = 0;
  detail::OpenFile file_;  // appends, wherever the end is
};

}  // namespace scarp

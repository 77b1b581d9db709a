// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/read_file.hpp"

namespace scarp {

/// A text file that grows line by line; every line is handed to the operating system at once. A checkpoint stores how
/// long it was.
class AppendedFile {
 public:
  /// continues: appends behind the last complete line of the file, which is not changed before a line is added;
  /// else, and where there is nothing, it begins with `head`
  /// \throws FileError when it cannot be written
  AppendedFile(std::filesystem::path path, std::string_view head, bool continues)
      : path_(std::move(path)), head_(head), bytes_(head.size()) {
    if (continues) {
      bytes_ = present() > 0 ? read_file(path_).find_last_of('\n') + 1 : 0;
    } else {
      write_file(path_, head_);
      file_ = detail::open_file(path_, "ab");
    }
  }

  /// \throws FileError when the line cannot be written
  void add(std::string_view line) {
    if (!file_) open_behind();
    if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0) {
      std::string const why = std::strerror(errno);
      file_.reset();  // the next line replaces what stands there of this one
      detail::throw_not_written(path_, why);
    }
    bytes_ += line.size();
  }

  SCARP_MEMBERS_EXCEPT((path_, head_, file_), bytes_)

  /// The next line will replace those that came after the checkpoint.
  /// \throws InputError when lines from before it are gone
  void after_loading() {
    if (present() < bytes_) {
      reject("'{}' has {} bytes (it had {} when the checkpoint was made): bring back the file of that run",
             path_.string(), present(), bytes_);
    }
    file_.reset();
  }

 private:
  std::uintmax_t present() const {
    std::error_code none;
    auto const bytes = std::filesystem::file_size(path_, none);
    return none ? 0 : bytes;
  }

  void open_behind() {
    if (bytes_ == 0) {
      write_file(path_, head_);
      bytes_ = head_.size();
    }
    std::error_code trouble;
    std::filesystem::resize_file(path_, bytes_, trouble);
    if (trouble) detail::throw_not_written(path_, trouble.message());
    file_ = detail::open_file(path_, "ab");
  }

  std::filesystem::path path_;
  std::string head_;
  std::uintmax_t bytes_;
  detail::OpenFile file_;  // appends, wherever the end is; none until what is behind it may go
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/process.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/time_stamp.hpp"

#if __has_include(<sys/file.h>)
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#define SCARP_HAS_FILE_LOCKS
#endif

namespace scarp {

/// A folder must not be written into, and has not been; the text reads "problem (why): suggestion".
class FolderError : public InputError {
 public:
  using InputError::InputError;
};

/// Reserves a folder for one writer of a kind, by a locked file in it. The kernel lets go of it when the process dies, however that
/// comes about. A folder that is not there is made; when the lock goes, so does what was made and got no content. A copy in a forked
/// process leaves everything to its parent.
class FolderLock {
 public:
  /// Locks nothing.
  FolderLock() = default;

  /// \throws FolderError when another lock holds the folder, or when it cannot be written
  explicit FolderLock(std::filesystem::path const& folder, std::string const& name = "run.lock")
      : path_(folder / name) {
    make(folder);
    try {
      lock(folder);
    } catch (...) {
      release();
      throw;
    }
  }

  FolderLock(FolderLock&& other) noexcept { swap(other); }  ///< The lock moves to this object.
  /// Exchanges both locks; the folder stays reserved.
  FolderLock& operator=(FolderLock&& other) noexcept {
    swap(other);
    return *this;
  }
  ~FolderLock() { release(); }

  /// False where the file system has no locks.
  bool holds() const { return held_; }

 private:
  void swap(FolderLock& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(made_, other.made_);
    std::swap(file_, other.file_);
    std::swap(held_, other.held_);
    std::swap(process_, other.process_);
  }

  void make(std::filesystem::path const& folder) {
    std::error_code trouble;
    for (auto above = folder; !above.empty() && !std::filesystem::exists(above, trouble); above = above.parent_path()) {
      if (trouble) break;
      made_.push_back(above);
    }
    if (!trouble) std::filesystem::create_directories(folder, trouble);
    if (!trouble && !std::filesystem::is_directory(folder, trouble))
      trouble = std::make_error_code(std::errc::not_a_directory);
    if (!trouble) return;
    release();
    throw_unusable(folder, trouble.message());
  }

  [[noreturn]] static void throw_unusable(std::filesystem::path const& folder, std::string_view why) {
    throw FolderError(fmt::format(
        "cannot write into '{}' ({}): check the folder and its permissions, or choose another", folder.string(), why));
  }

#ifdef SCARP_HAS_FILE_LOCKS
  void lock(std::filesystem::path const& folder) {
    for (;;) {
      file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (file_ < 0) throw_unusable(folder, std::strerror(errno));
      held_ = ::flock(file_, LOCK_EX | LOCK_NB) == 0;
      if (!held_ && errno == EWOULDBLOCK) {
        std::string const holder = content();
        ::close(std::exchange(file_, -1));
        throw FolderError(
            fmt::format("'{}' is in use ({} writes there): wait until it has ended, or choose another folder",
                        folder.string(), holder.empty() ? "another run" : holder));
      }
      struct stat ours {};
      struct stat there {};
      bool const same = ::fstat(file_, &ours) == 0 && ::stat(path_.c_str(), &there) == 0 &&
                        ours.st_ino == there.st_ino && ours.st_dev == there.st_dev;
      if (same || !held_) break;  // else its holder has removed it in between
      ::close(std::exchange(file_, -1));
    }
    char host[256] = "";
    static_cast<void>(::gethostname(host, sizeof host - 1));
    auto const text = fmt::format("process {} of {} since {}", process_, host, time_stamp());
    if (held_ && ::ftruncate(file_, 0) == 0) static_cast<void>(!::write(file_, text.data(), text.size()));
  }

  std::string content() const {
    char text[400];
    auto const length = ::read(file_, text, sizeof text);
    return length > 0 ? std::string(text, static_cast<std::size_t>(length)) : "";
  }

  void release() noexcept {
    if (file_ >= 0) {
      if (held_ && process_ == detail::process_number()) ::unlink(path_.c_str());
      ::close(std::exchange(file_, -1));
    }
    remove_made();
  }
#else
  void lock(std::filesystem::path const&) {}
  void release() noexcept { remove_made(); }
#endif

  void remove_made() noexcept {
    std::error_code ignored;
    if (process_ != detail::process_number()) made_.clear();
    for (auto const& folder : made_) std::filesystem::remove(folder, ignored);  // not one that holds anything
    made_.clear();
  }

  std::filesystem::path path_{};
  std::vector<std::filesystem::path> made_{};  ///< innermost first
  int file_ = -1;
  bool held_ = false;
  long process_ = detail::process_number();  ///< that made the lock
};

}  // namespace scarp

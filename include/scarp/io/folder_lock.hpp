// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/process.hpp"
#include "scarp/io/atomic_file.hpp"

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

/// Reserves a folder for one writer of a kind, by a locked file in it. The kernel lets go of it when the process dies,
/// however that comes about. A folder that is not there is made; when the lock goes, so does what was made and got no
/// content. A copy in a forked process leaves everything to its parent.
class FolderLock {
 public:
  /// Locks nothing.
  FolderLock() = default;

  /// \throws FolderError when another lock holds the folder, or when it cannot be written
  explicit FolderLock(std::filesystem::path const& folder, std::string const& name = "run.lock")
      : reserved_(std::make_unique<Reserved>(folder / name)) {
    reserved_->make(folder);
    reserved_->lock(folder);
  }

  /// False where the file system has no locks.
  bool holds() const { return reserved_ && reserved_->held; }

 private:
  /// What goes with the lock.
  struct Reserved {
    std::filesystem::path path;
    std::vector<std::filesystem::path> made{};  ///< innermost first
    int file = -1;
    bool held = false;
    long process = detail::process_number();  ///< that made the lock

    explicit Reserved(std::filesystem::path lock_file) : path(std::move(lock_file)) {}
    Reserved(Reserved const&) = delete;
    Reserved& operator=(Reserved const&) = delete;
    ~Reserved() {
      unlock();
      std::error_code ignored;
      if (process != detail::process_number()) made.clear();
      for (auto const& folder : made) std::filesystem::remove(folder, ignored);  // not one that holds anything
    }

    void make(std::filesystem::path const& folder) {
      std::error_code trouble;
      for (auto above = folder; !above.empty() && !std::filesystem::exists(above, trouble);
           above = above.parent_path()) {
        if (trouble) break;
        made.push_back(above);
      }
      if (!trouble) std::filesystem::create_directories(folder, trouble);
      if (!trouble && !std::filesystem::is_directory(folder, trouble))
        trouble = std::make_error_code(std::errc::not_a_directory);
      if (trouble) throw_unusable(folder, trouble.message());
    }

#ifdef SCARP_HAS_FILE_LOCKS
    void lock(std::filesystem::path const& folder) {
      for (;;) {
        file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (file < 0) throw_unusable(folder, std::strerror(errno));
        held = ::flock(file, LOCK_EX | LOCK_NB) == 0;
        if (!held && errno == EWOULDBLOCK) {
          std::string const holder = content();
          throw FolderError(
              fmt::format("'{}' is in use ({} writes there): wait until it has ended, or choose another folder",
                          folder.string(), holder.empty() ? "another run" : holder));
        }
        struct stat ours {};
        struct stat there {};
        bool const same = ::fstat(file, &ours) == 0 && ::stat(path.c_str(), &there) == 0 &&
                          ours.st_ino == there.st_ino && ours.st_dev == there.st_dev;
        if (same || !held) break;  // else its holder has removed it in between
        ::close(std::exchange(file, -1));
      }
      char host[256] = "";
      static_cast<void>(::gethostname(host, sizeof host - 1));
      auto const text = fmt::format("process {} of {} since {}", process, host, time_stamp());
      if (held && ::ftruncate(file, 0) == 0) static_cast<void>(!::write(file, text.data(), text.size()));
    }

    std::string content() const {
      char text[400];
      auto const length = ::read(file, text, sizeof text);
      return length > 0 ? std::string(text, static_cast<std::size_t>(length)) : "";
    }

    void unlock() {
      if (file < 0) return;
      if (held && process == detail::process_number()) ::unlink(path.c_str());
      ::close(file);
    }
#else
    void lock(std::filesystem::path const&) {}
    void unlock() {}
#endif
  };

  [[noreturn]] static void throw_unusable(std::filesystem::path const& folder, std::string_view why) {
    throw FolderError(fmt::format(
        "cannot write into '{}' ({}): check the folder and its permissions, or choose another", folder.string(), why));
  }

  std::unique_ptr<Reserved> reserved_;
};

}  // namespace scarp

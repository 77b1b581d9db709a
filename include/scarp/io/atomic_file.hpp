// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "scarp/core/process.hpp"

#if __has_include(<unistd.h>)
#include <fcntl.h>
#include <unistd.h>
#endif

namespace scarp {

/// A file could not be written or read; the text reads "problem (why): suggestion".
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What must have happened when a file counts as written.
enum class Durability {
  handed_over,  ///< the operating system has it: survives the end of the program
  on_disk       ///< the disk has it: survives a power cut, slower
};

namespace detail {

/// Whether there is such a folder; false where the system denies the look.
inline bool is_folder(std::filesystem::path const& path) {
  std::error_code none;
  return std::filesystem::is_directory(path, none);
}

struct CloseFile {
  void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] inline void throw_not_written(std::filesystem::path const& path, std::string_view why) {
  throw FileError(
      fmt::format("cannot write '{}' ({}): check the folder, its permissions and the free space", path.string(), why));
}

/// opened: the file to open; wanted: the one that messages name, in the same folder
inline OpenFile open_file(std::filesystem::path const& opened, char const* mode, std::filesystem::path const& wanted) {
  auto const folder = wanted.parent_path();
  if (!folder.empty() && !is_folder(folder)) {
    std::error_code unknown;
    bool const is_taken = std::filesystem::exists(folder, unknown);
    if (is_taken)
      throw FileError(
          fmt::format("cannot write '{}' ('{}' is no folder): name another one", wanted.string(), folder.string()));
    throw FileError(
        fmt::format("cannot write '{}' (there is no folder '{}'): create it first", wanted.string(), folder.string()));
  }
  OpenFile file(std::fopen(opened.string().c_str(), mode));
  if (!file) {
    throw_not_written(wanted, std::strerror(errno));
  }
  return file;
}

inline OpenFile open_file(std::filesystem::path const& path, char const* mode) { return open_file(path, mode, path); }

/// A name in the folder of `path` that no other writer of this machine uses at the same time.
inline std::filesystem::path partial_name(std::filesystem::path const& path) {
  static std::atomic<unsigned> calls{0};
  auto name = path;
  name += fmt::format(".partial-{}-{}", process_number(), calls++);
  return name;
}

inline bool flush(std::FILE* file, Durability durability) {
  bool done = std::fflush(file) == 0;
#if __has_include(<unistd.h>)
  if (durability == Durability::on_disk) {
    done = done && ::fsync(::fileno(file)) == 0;
  }
#else
  static_cast<void>(durability);
#endif
  return done;
}

/// After a crash of the machine a file is found under its new name only if its folder has reached the disk too.
inline bool flush_folder(std::filesystem::path const& folder) {
#if __has_include(<unistd.h>)
  int const opened = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (opened < 0) return false;
  bool const done = ::fsync(opened) == 0;
  ::close(opened);
  return done;
#else
  static_cast<void>(folder);
  return true;
#endif
}

/// The file that a name stands for: the one that a link leads to, or the name.
/// \throws FileError for what a file must not replace
inline std::filesystem::path replaceable(std::filesystem::path const& name) {
  std::error_code none;
  auto const there = std::filesystem::status(name, none);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
    throw FileError(fmt::format("cannot write '{}' (it is a {}): give the name of a file", name.string(),
                                std::filesystem::is_directory(there) ? "folder" : "device or a pipe"));
  auto end = name;
  for (int links = 0; links < 40 && std::filesystem::is_symlink(end, none); ++links)
    end = end.parent_path() / std::filesystem::read_symlink(end, none);  // an absolute one stands for itself
  return end;
}

}  // namespace detail

/// Makes a folder, with those above it, where it is missing.
/// \throws FileError
inline void make_folder(std::filesystem::path const& folder) {
  std::error_code trouble;
  std::filesystem::create_directories(folder, trouble);
  if (!trouble && !detail::is_folder(folder)) trouble = std::make_error_code(std::errc::not_a_directory);
  if (trouble) detail::throw_not_written(folder, trouble.message());
}

/// Writes a whole file: either all of `content` stands under `path` afterwards, or what was there before.
/// The content goes to a temporary name in the same folder, which then replaces the old file; a link stays, and the
/// file that it leads to is replaced.
/// \throws FileError when the folder is missing or not writable, the disk is full, or the name is that of a folder, a
/// device or a pipe
inline void write_file(std::filesystem::path const& name, std::string_view content,
                       Durability durability = Durability::handed_over) {
  auto const path = detail::replaceable(name);
  auto const partial = detail::partial_name(path);
  std::error_code trouble;
  {
    auto file = detail::open_file(partial, "wb", path);
    bool const written = std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
    // Quotas and network file systems may report what is missing when the file is closed.
    if (!written || !detail::flush(file.get(), durability) || std::fclose(file.release()) != 0) {
      std::string const why = std::strerror(errno);
      std::filesystem::remove(partial, trouble);
      detail::throw_not_written(path, why);
    }
  }
  std::filesystem::rename(partial, path, trouble);
  if (trouble) {
    std::string const why = trouble.message();
    std::filesystem::remove(partial, trouble);
    detail::throw_not_written(path, why);
  }
  if (durability == Durability::on_disk && !detail::flush_folder(path.parent_path()))
    detail::throw_not_written(path, std::strerror(errno));
}

}  // namespace scarp

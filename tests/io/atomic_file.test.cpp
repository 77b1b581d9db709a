// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/atomic_file.hpp"

#include <dlfcn.h>
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/files.hpp"
#include "support/refusals.hpp"

using samples::content;
using samples::ScratchFolder;

TEST_CASE("a file is written as a whole and leaves nothing beside it") {
  ScratchFolder const folder;
  std::string const bytes("line\nzero\0and more", 18);
  scarp::write_file(folder / "a.txt", bytes);
  CHECK(content(folder / "a.txt") == bytes);
  scarp::write_file(folder / "a.txt", "short", scarp::Durability::on_disk);
  CHECK(content(folder / "a.txt") == "short");
  scarp::write_file(folder / "empty.txt", "");
  CHECK(content(folder / "empty.txt").empty());
  CHECK(folder.file_count() == 2);
}

TEST_CASE("files that are being written have names of their own, for each process and each call") {
  auto const first = scarp::detail::partial_name("results/a.txt");
  CHECK(first.parent_path() == "results");
  CHECK(first.filename().string().starts_with("a.txt.partial-" + std::to_string(::getpid()) + "-"));
  CHECK(scarp::detail::partial_name("results/a.txt") != first);
}

namespace {
bool close_fails = false;
}

/// In place of the C library's, which it calls.
extern "C" int fclose(std::FILE* file) {
  static auto* const real = reinterpret_cast<int (*)(std::FILE*)>(::dlsym(RTLD_NEXT, "fclose"));
  int const closed = real(file);
  if (!close_fails) return closed;
  errno = EDQUOT;
  return EOF;
}

TEST_CASE("the old file stays as it was when the disk reports at last that the new one does not fit") {
  ScratchFolder const folder;
  scarp::write_file(folder / "a.csv", "old");
  close_fails = true;
  auto const said = samples::message_of<scarp::FileError>([&] { scarp::write_file(folder / "a.csv", "new"); });
  close_fails = false;
  CHECK(said == samples::Naming{"a.csv", std::strerror(EDQUOT)});
  CHECK(content(folder / "a.csv") == "old");
  CHECK(folder.file_count() == 1);
}

TEST_CASE("names that no file can have, and folders that cannot be made, are complaints of one type") {
  ScratchFolder const folder;
  scarp::write_file(folder / "file", "");
  std::string const long_name(400, 'n');
  auto const write = [&](std::filesystem::path const& path) {
    return samples::message_of<scarp::FileError>([&] { scarp::write_file(path, "text"); });
  };
  CHECK(write(folder / (long_name + ".vtu")) == samples::Naming{"cannot write", long_name});
  CHECK(write(folder / long_name / "a.vtu") == samples::Naming{"cannot write", "there is no folder"});
  CHECK(write(folder / "file/a.vtu") == samples::Naming{"cannot write", "is no folder"});
  for (auto const& made : {folder / "file", folder / "file/below", folder / long_name})
    CHECK(samples::message_of<scarp::FileError>([&] { scarp::make_folder(made); }) == samples::Naming{made.string()});
  CHECK_NOTHROW(scarp::make_folder(folder / "a/b"));
  CHECK_NOTHROW(scarp::make_folder(folder / "a/b"));
}

TEST_CASE("a missing folder is named in the complaint") {
  ScratchFolder const folder;
  auto const path = folder / "missing/a.txt";
  CHECK(samples::message_of<scarp::FileError>([&] { scarp::write_file(path, "text"); }) ==
        samples::Naming{path.string(), "no folder '" + path.parent_path().string() + "'"});
}

TEST_CASE("the old file stays as it was when the new one cannot take its place") {
  ScratchFolder const folder;
  std::filesystem::create_directory(folder / "results");
  scarp::write_file(folder / "results/old.txt", "precious");
  CHECK(samples::message_of<scarp::FileError>([&] {
          static_cast<void>(scarp::write_file(folder / "results", "text"));
        }) == samples::Naming{"results"});  // the name of a folder
  CHECK(content(folder / "results/old.txt") == "precious");
  CHECK(folder.file_count() == 1);
}

TEST_CASE("the old file stays as it was when the new one cannot be created") {
  ScratchFolder const folder;
  // A name of 250 characters is allowed, but not the longer temporary name beside it: writing fails before anything is
  // touched. (Permissions would not stop a test that runs as root.)
  std::string const name(250, 'x');
  { std::ofstream(folder / name) << "precious"; }
  REQUIRE(content(folder / name) == "precious");
  CHECK(samples::message_of<scarp::FileError>([&] { static_cast<void>(scarp::write_file(folder / name, "text")); }) ==
        samples::Naming{name});
  CHECK(content(folder / name) == "precious");
  CHECK(folder.file_count() == 1);
}

TEST_CASE("a full disk is an error and not a shorter file") {
  if (std::filesystem::exists("/dev/full")) {
    auto const file = scarp::detail::open_file("/dev/full", "wb");
    CHECK(std::fwrite("text", 1, 4, file.get()) == 4);  // still in the buffer
    CHECK_FALSE(scarp::detail::flush(file.get(), scarp::Durability::handed_over));
  }
}

TEST_CASE("what is no file is not replaced, and a link goes on leading to its file") {
  ScratchFolder const folder;
  auto const pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(samples::message_of<scarp::FileError>([&] { scarp::write_file(pipe, "text"); }) ==
        samples::Naming{"it is a device or a pipe"});
  CHECK(std::filesystem::is_fifo(pipe));
  CHECK(samples::message_of<scarp::FileError>([&] { scarp::write_file("/dev/null", "text"); }) ==
        samples::Naming{"it is a device or a pipe"});
  std::filesystem::create_directory(folder / "disk");
  for (char const* target : {"disk/old.csv", "disk/new.csv"}) {
    if (std::string_view(target) == "disk/old.csv") scarp::write_file(folder / target, "old");
    auto const link = folder / (std::string(target).substr(5) + ".link");
    std::filesystem::create_symlink(target, link);
    scarp::write_file(link, "new");
    CHECK(std::filesystem::is_symlink(link));
    CHECK(content(folder / target) == "new");
  }
}

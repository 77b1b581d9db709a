// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/atomic_file.hpp"

#include <doctest/doctest.h>
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

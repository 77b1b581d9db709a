// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/folder_lock.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>

#include "support/files.hpp"
#include "support/refusals.hpp"

using samples::content;
using samples::ScratchFolder;
using scarp::FolderError;
using scarp::FolderLock;

TEST_CASE("a locked folder is refused to a second writer, who is told of the first and leaves nothing") {
  ScratchFolder const folder;
  {
    FolderLock const lock(folder.path());
    REQUIRE(lock.holds());
    CHECK_THROWS_WITH_AS(FolderLock(folder.path()), doctest::Contains("' is in use (process "), FolderError);
    CHECK(folder.file_count() == 1);
    CHECK(samples::message_of<FolderError>([&] { static_cast<void>(FolderLock(folder.path())); }) ==
          samples::Naming{"in use"});
  }
  CHECK(folder.file_count() == 0);
  CHECK(FolderLock(folder.path()).holds());
}

TEST_CASE("the lock of a process that dies does not outlive it, though its file does") {
  ScratchFolder const folder;
  int const child = ::fork();
  if (child == 0) {
    FolderLock const lock(folder.path());
    ::_exit(lock.holds() ? 7 : 1);  // no destructors
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(WEXITSTATUS(status) == 7);
  CHECK(folder.file_count() == 1);
  CHECK(FolderLock(folder.path()).holds());
}

TEST_CASE("a forked process that ends leaves lock, file and folders to its parent") {
  ScratchFolder const folder;
  {
    FolderLock lock(folder / "output");
    int const child = ::fork();
    if (child == 0) {
      { FolderLock const copy = std::move(lock); }
      ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(std::filesystem::exists(folder / "output/run.lock"));
    CHECK_THROWS_WITH_AS(FolderLock(folder / "output"), doctest::Contains("' is in use (process "), FolderError);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "output"));
}

TEST_CASE("folders that are missing are made, and go with the lock where nothing was put into them") {
  ScratchFolder const folder;
  {
    FolderLock const lock(folder / "output/empty");
    FolderLock const other(folder / "output/full");
    scarp::write_file(folder / "output/full/table.csv", "1\n");
    CHECK(std::filesystem::is_directory(folder / "output/empty"));
  }
  CHECK_FALSE(std::filesystem::exists(folder / "output/empty"));
  CHECK(content(folder / "output/full/table.csv") == "1\n");
}

TEST_CASE("a folder that cannot be written is refused with the system's reason") {
  ScratchFolder const folder;
  std::filesystem::create_symlink("circle", folder / "circle");
  scarp::write_file(folder / "file", "");
  for (std::filesystem::path const& path : {folder / "circle/out", folder / "file/out", folder / "file",
                                            std::filesystem::path("/proc/scarp/out"), folder / std::string(300, 'a')}) {
    CAPTURE(path.string());
    CHECK_THROWS_WITH_AS(static_cast<void>(FolderLock(path)), doctest::Contains("cannot write into '"), FolderError);
  }
  CHECK(folder.file_count() == 2);
}

TEST_CASE("a lock that is a link is refused, and the file behind it stays") {
  ScratchFolder const folder;
  scarp::write_file(folder / "results", "of years");
  std::filesystem::create_symlink("results", folder / "run.lock");
  CHECK_THROWS_WITH_AS(FolderLock(folder.path()), doctest::Contains("cannot write into '"), FolderError);
  CHECK(content(folder / "results") == "of years");
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/checkpoint_files.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::ScratchFolder;

using scarp::CheckpointFiles;

void save(CheckpointFiles& files, int number) {
  files.save([&](scarp::StateWriter& writer) { writer("number", number); });
}

int loaded(CheckpointFiles const& files) {
  int number = 0;
  files.load([&](scarp::StateReader& reader) { reader("number", number); });
  return number;
}

}  // namespace

TEST_CASE("a run is saved by time alone and starts afresh, unless it is requested more") {
  CHECK_FALSE(scarp::CheckpointSettings{}.resume);
  CHECK(scarp::CheckpointSettings{}.every_attempts == 0);
  CHECK_FALSE(CheckpointFiles{}.saves());
}

TEST_CASE("a run that is resumed goes on from the newest checkpoint and numbers those that follow behind it") {
  ScratchFolder const folder;
  {
    CheckpointFiles files({.folder = folder / "saved"}, "soil: sand\n");
    CHECK(files.saves());
    CHECK_FALSE(files.resumes());
    for (int number = 1; number <= 3; ++number) save(files, number);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "saved/checkpoint_000001"));
  CHECK(std::filesystem::exists(folder / "saved/checkpoint_000002"));
  CheckpointFiles files({.folder = folder / "saved", .resume = true}, "soil: sand\n");
  CHECK(files.resumes());
  CHECK(files.newest() == folder / "saved/checkpoint_000003");
  CHECK(loaded(files) == 3);
  save(files, 4);
  CHECK(files.newest() == folder / "saved/checkpoint_000004");
  CHECK_FALSE(std::filesystem::exists(folder / "saved/checkpoint_000002"));
}

TEST_CASE("a folder with checkpoints is refused to a run that starts afresh and to another scene") {
  ScratchFolder const folder;
  {
    CheckpointFiles files({.folder = folder / "saved"}, "soil: sand\n");
    save(files, 1);
  }
  CHECK(samples::message_of<scarp::CheckpointError>([&] {
          static_cast<void>(CheckpointFiles({.folder = folder / "saved"}, "soil: sand\n"));
        }) == samples::Naming{"saved", "earlier run"});
  CHECK_THROWS_WITH_AS(CheckpointFiles({.folder = folder / "saved", .resume = true}, "soil: clay\n"),
                       doctest::Contains("'soil: sand' there, 'soil: clay' here"), scarp::CheckpointError);
}

TEST_CASE("where the newest checkpoint is harmed the one before is named if it is sound") {
  ScratchFolder const folder;
  {
    CheckpointFiles files({.folder = folder / "saved"}, "soil: sand\n");
    save(files, 1);
    save(files, 2);
  }
  scarp::write_file(folder / "saved/checkpoint_000002", "harmed");
  scarp::CheckpointSettings const settings{.folder = folder / "saved", .resume = true};
  CHECK_THROWS_WITH_AS(CheckpointFiles(settings, "soil: sand\n"),
                       doctest::Contains("checkpoint_000001': to continue from that"), scarp::CheckpointError);
  scarp::write_file(folder / "saved/checkpoint_000001", "harmed too");
  auto const said = samples::message_of<scarp::CheckpointError>([&] { CheckpointFiles(settings, "soil: sand\n"); });
  CHECK(samples::contains(said, "checkpoint_000002"));
  CHECK_FALSE(samples::contains(said, "the one before"));
}

TEST_CASE("settings that cannot be are refused, and folders that cannot be looked into") {
  ScratchFolder const folder;
  CHECK_REFUSED(CheckpointFiles({.folder = folder / "saved", .every_seconds = -1.0}, ""),
                "time between two checkpoints", "-1");
  CHECK_REFUSED(CheckpointFiles({.folder = folder / "saved", .every_seconds = std::nan("")}, ""),
                "time between two checkpoints", "nan");
  CHECK_REFUSED(CheckpointFiles({.folder = folder / "saved", .every_attempts = -1}, ""),
                "attempts between two checkpoints", "-1");
  scarp::write_file(folder / "file", "");
  CHECK_REFUSED(CheckpointFiles({.folder = folder / "file/saved"}, ""), "file/saved", "Not a directory");
  CHECK_REFUSED(CheckpointFiles({.folder = folder / "file/saved", .locks = false}, ""), "file/saved",
                "Not a directory");
}

TEST_CASE("a folder of checkpoints has one owner, and other ranks of a run, which do not lock it") {
  ScratchFolder const folder;
  CheckpointFiles const owner({.folder = folder / "saved"}, "soil: sand\n");
  CHECK_REFUSED(CheckpointFiles({.folder = folder / "saved"}, "soil: sand\n"), "is in use");
  CHECK_NOTHROW(CheckpointFiles({.folder = folder / "saved", .locks = false}, "soil: sand\n"));
}

TEST_CASE("a folder that vanishes during a run is made again, and one that cannot be is a complaint about a file") {
  ScratchFolder const folder;
  auto const states = folder / "saved/states";
  CheckpointFiles files({.folder = states}, "soil: clay\n");
  save(files, 1);
  std::filesystem::remove_all(folder / "saved");
  save(files, 2);
  CHECK(std::filesystem::exists(files.newest()));
  std::filesystem::remove_all(folder / "saved");
  scarp::write_file(folder / "saved", "in the way");
  CHECK(samples::message_of<scarp::FileError>([&] { save(files, 3); }) ==
        samples::Naming{states.string(), "Not a directory"});
  std::filesystem::remove(folder / "saved");
  save(files, 3);
  CHECK(loaded(CheckpointFiles({.folder = states, .resume = true, .locks = false}, "soil: clay\n")) == 3);
}

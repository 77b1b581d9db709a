// SPDX-License-Identifier: BSL-1.0
#include "scarp/run/run_folder.hpp"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <csignal>
#include <map>

#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::contains;
using samples::content;
using samples::ScratchFolder;

using scarp::CheckpointFiles;
using scarp::FolderError;
using scarp::RunFolder;

constexpr char const* scene = "size = 1\nseed = 7\n";

scarp::RunRecord record() {
  return {.program = "sample",
          .build = {{"version", "1"}},
          .options = {{"size", "1"}, {"output", "a \"b\"\\\n"}},
          .defaults = {{"size", "2"}}};
}

CheckpointFiles files(ScratchFolder const& folder, char const* name, bool resume, char const* text = scene) {
  return {{.folder = folder / name, .resume = resume}, text};
}

/// A run that saves itself once, unless it dies before.
std::string run(ScratchFolder const& folder, char const* output, CheckpointFiles checkpoints, bool saves = true,
                char const* end = nullptr) {
  RunFolder own({.folder = folder / output}, record(), &checkpoints);
  own.begin();
  if (saves && checkpoints.saves()) checkpoints.save([](scarp::StateWriter&) {});
  scarp::write_file(folder / output / "summary.json", std::string("of ") + output);
  if (end != nullptr) own.end(end);
  return own.record().identity;
}

std::map<std::string, std::string> everything(ScratchFolder const& folder) {
  std::map<std::string, std::string> found;
  for (auto const& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    found[entry.path().string()] = entry.is_directory() ? "folder" : content(entry.path());
  return found;
}

/// What a folder is refused with; the refusal must leave everything as it was.
template <class Action>
std::string refusal(ScratchFolder const& folder, Action const& action) {
  auto const before = everything(folder);
  std::string const said = samples::message_of<FolderError>(action);
  CHECK(everything(folder) == before);
  return said;
}

/// Writing beyond so many bytes of a file fails, as on a full disk, as long as it lives.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &limit_);
    auto small = limit_;
    small.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  FullDisk(FullDisk const&) = delete;
  FullDisk& operator=(FullDisk const&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, before_);
  }

 private:
  void (*before_)(int);
  rlimit limit_{};
};

}  // namespace

TEST_CASE("a record is read as it was written, also by a program that knows other members") {
  auto written = record();
  written.identity = "one";
  written.state = "running";
  written.started = "then";
  written.scene = scene;
  auto const read = scarp::RunRecord::from(written.text());
  CHECK(read.text() == written.text());
  CHECK(read.options == written.options);
  CHECK(read.defaults == written.defaults);
  auto const later =
      scarp::RunRecord::from(R"({"extra": {"state": "no"}, "number": 1.5, "identity": "x","state":"running"})");
  CHECK(later.identity == "x");
  CHECK(later.state == "running");
  auto const nested = scarp::RunRecord::from(
      R"({"identity": "x", "state": "running", "build": {"git": {"commit": "1"}, "compiler": "g++"},
          "later": {"deep": {"x": "1"}, "identity": "y", "state": "finished"}, "list": [{"state": "no"}, ["state", "no"]]})");
  CHECK(nested.identity == "x");
  CHECK(nested.state == "running");
  CHECK(nested.build == scarp::RunRecord::Lines{{"compiler", "g++"}});
  for (char const* text : {"", "{}", "{\"identity\": \"x\"}", "{\"identity", "\"\\u00"})
    CHECK_REFUSED(scarp::RunRecord::from(text), "record");
}

TEST_CASE("a run finds a new folder or an empty one, keeps it for itself, and says in the record how it ended") {
  ScratchFolder const folder;
  {
    RunFolder own({.folder = folder / "output/out"}, record());
    CHECK_FALSE(std::filesystem::exists(folder / "output/out/run.json"));
    own.begin();
    CHECK(scarp::RunRecord::from(content(folder / "output/out/run.json")).state == "running");
    CHECK(contains(refusal(folder, [&] { RunFolder({.folder = folder / "output/out", .overwrite = true}, record()); }),
                   "is in use (process "));
    own.end("finished");
  }
  auto const left = scarp::RunRecord::from(content(folder / "output/out/run.json"));
  CHECK(left.has_finished());
  CHECK(left.options == record().options);
  CHECK_FALSE(std::filesystem::exists(folder / "output/out/run.lock"));
}

TEST_CASE("a run that is given up before it begins leaves no trace") {
  ScratchFolder const folder;
  CHECK(refusal(folder, [&] {
          RunFolder const own({.folder = folder / "output/out"}, record());
          throw FolderError("the scene is impossible");
        }) == "the scene is impossible");
}

TEST_CASE("a new run does not take a folder with results unless it may overwrite them") {
  ScratchFolder const folder;
  run(folder, "finished", {}, false, "finished");
  run(folder, "killed", {});
  run(folder, "stopped", {}, false, "too many iterations");
  std::filesystem::create_directory(folder / "older");
  scarp::write_file(folder / "older/summary.json", "{}");
  for (auto const& [name, words] : {std::pair{"finished", "and finished (its results would be lost)"},
                                    {"killed", "and not finished (its"},
                                    {"stopped", "and stopped (too many iterations)"},
                                    {"older", "results of another run, such as 'summary.json'"}}) {
    auto const* const of = name;
    auto const text = refusal(folder, [&] { run(folder, of, {}); });
    CHECK_MESSAGE(contains(text, words), text);
    CHECK(contains(text, "--overwrite"));
    RunFolder own({.folder = folder / name, .overwrite = true}, record());
    own.begin();
  }
  std::filesystem::create_directory(folder / "notes");
  scarp::write_file(folder / "notes/mine.txt", "");
  CHECK_FALSE(run(folder, "notes", {}).empty());
  scarp::write_file(folder / "notes/run.json", "[1, 2]");
  CHECK(contains(refusal(folder, [&] { run(folder, "notes", {}); }), "it is no record of a run"));
}

TEST_CASE("runs with records of other names share a folder, but not at once") {
  ScratchFolder const folder;
  run(folder, "out", {}, false, "finished");
  CHECK_NOTHROW(RunFolder({.folder = folder / "out", .record = "run_of_another_kind.json", .results = {}}, record()));
}

TEST_CASE("a run goes on in its own folder only, under its own name, and a refusal touches nothing") {
  ScratchFolder const folder;
  auto const identity = run(folder, "r5", files(folder, "k5", true), true, "interrupted");
  auto const other = run(folder, "r6", files(folder, "k6", true), true, "finished");
  CHECK(identity != other);
  auto const text = refusal(folder, [&] { run(folder, "r6", files(folder, "k5", true)); });
  CHECK_MESSAGE(contains(text, "r6' holds a run of sample, started "), text);
  CHECK_MESSAGE(contains(text, "r5'): give that folder"), text);
  CHECK(contains(refusal(folder, [&] { run(folder, "r7", files(folder, "k5", true)); }),
                 "r7' holds no run, not the run that"));
  auto const started = scarp::RunRecord::from(content(folder / "r5/run.json")).started;
  CHECK(run(folder, "r5", files(folder, "k5", true), true, "finished") == identity);
  CHECK(scarp::RunRecord::from(content(folder / "r5/run.json")).started == started);
  CHECK(run(folder, "r5", files(folder, "k5", true), true, "finished") == identity);  // nothing was left to do
}

TEST_CASE("a wrong name of the checkpoints does not start a run afresh over another one's results") {
  ScratchFolder const folder;
  run(folder, "out", files(folder, "states", true), true, "finished");
  auto const typo = refusal(folder, [&] { run(folder, "out", files(folder, "statse", true)); });
  CHECK_MESSAGE(contains(typo, "there is no checkpoint in '"), typo);
  CHECK_MESSAGE(contains(typo, "(it saves into '" + std::filesystem::weakly_canonical(folder / "states").string()),
                typo);
  CHECK_FALSE(contains(typo, "--overwrite"));
  run(folder, "stopped", files(folder, "other", true), true, "interrupted");
  CHECK(contains(refusal(folder, [&] { run(folder, "stopped", files(folder, "otehr", true)); }),
                 "give that folder to resume"));
}

TEST_CASE("a run that was killed before its first checkpoint starts afresh where it was") {
  ScratchFolder const folder;
  run(folder, "out", files(folder, "states", true), false);
  auto const said = refusal(folder, [&] { run(folder, "out", files(folder, "states", true, "size = 2\n"), false); });
  CHECK_MESSAGE(contains(said, "its scene is another"), said);
  CHECK(contains(refusal(folder, [&] { run(folder, "out", files(folder, "states", false), false); }), "--overwrite"));
  CHECK_FALSE(run(folder, "out", files(folder, "states", true), true, "finished").empty());
}

TEST_CASE(
    "a run that an exception ends is not called running, and one that was refused before it began leaves no record") {
  ScratchFolder const folder;
  CHECK_THROWS_AS(
      [&] {
        RunFolder own({.folder = folder / "out"}, record());
        own.begin();
        throw scarp::FileError("the disk is full");
      }(),
      scarp::FileError);
  CHECK(scarp::RunRecord::from(content(folder / "out/run.json")).state == "failed");
}

TEST_CASE("a run whose folders have names that are not UTF-8 goes on there") {
  ScratchFolder const folder;
  auto const identity = run(folder,
                            "b\xf6"
                            "den",
                            files(folder, "st\xe4nde", true), true, "interrupted");
  auto const text = content(folder /
                            "b\xf6"
                            "den/run.json");
  CHECK(scarp::valid_utf8(text) == text);
  CHECK(run(folder,
            "b\xf6"
            "den",
            files(folder, "st\xe4nde", true), true, "finished") == identity);
}

TEST_CASE("two programs do not save into one folder of checkpoints") {
  ScratchFolder const folder;
  auto const one = files(folder, "states", true);
  CHECK(contains(refusal(folder, [&] { files(folder, "states", true); }), "is in use (process "));
}

TEST_CASE("a run that was killed before its first checkpoint starts afresh whatever the bytes of its scene") {
  ScratchFolder const folder;
  constexpr char const* latin =
      "mesh = b\xf6"
      "den.msh\n";
  run(folder, "out", files(folder, "states", true, latin), false);
  CHECK_FALSE(run(folder, "out", files(folder, "states", true, latin), true, "finished").empty());
}

TEST_CASE("a record that has no room on a full disk stays as it was") {
  ScratchFolder const folder;
  RunFolder own({.folder = folder / "out"}, record());
  own.begin();
  auto const before = content(folder / "out/run.json");
  {
    FullDisk const full(before.size());
    auto const said = samples::message_of<scarp::FileError>([&] { own.end(std::string(400, 'x')); });
    CHECK_MESSAGE(contains(said, "cannot write"), said);
  }
  CHECK(content(folder / "out/run.json") == before);
  CHECK(own.record().state == "running");
  own.end("finished");
  CHECK(scarp::RunRecord::from(content(folder / "out/run.json")).has_finished());
}

TEST_CASE("a run whose record could not be written begins when there is room") {
  ScratchFolder const folder;
  RunFolder own({.folder = folder / "out"}, record());
  {
    FullDisk const full(8);
    auto const said = samples::message_of<scarp::FileError>([&] { own.begin(); });
    CHECK_MESSAGE(contains(said, "cannot write"), said);
  }
  CHECK(own.record().state.empty());
  own.begin();
  CHECK(scarp::RunRecord::from(content(folder / "out/run.json")).state == "running");
}

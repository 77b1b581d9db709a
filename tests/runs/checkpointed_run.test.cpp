// SPDX-License-Identifier: BSL-1.0
#include "scarp/run/checkpointed_run.hpp"

#include <doctest/doctest.h>
#ifdef __linux__
#include <malloc.h>
#endif
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <optional>
#include <set>

#include "scarp/budget/error_budget.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/observe/observers.hpp"
#include "support/block.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::contains;
using samples::content;
using samples::ScratchFolder;

using scarp::CheckpointError;
using Block = samples::Block<samples::Softening>;

constexpr char const* scene = "size = 1\nseed = 7\n";

struct LoadLog : scarp::NeverStops {
  scarp::CsvLog log;
  int lost_after = 1 << 30;  ///< attempts

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const& report) {
    if (--lost_after == 0) throw scarp::FileError("cannot write 'log.csv'");
    log.add(report.step, report.load, report.residual(), name(report.verdict.reason));
  }
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("log", self.log);
  }
};

struct Killed {};

/// Files can become as long as that; writing beyond it fails as on a full disk.
void limit_files(rlim_t bytes) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_FSIZE, &limit);
}

/// Asks to stop, or ends without a word as a killed process does.
struct Ending {
  int stop_after = 1 << 30;  ///< attempts
  int die_after = 1 << 30;
  mutable int questions = 1 << 30;  ///< after which it asks to stop, within an attempt or before one
  int full_after = 1 << 30;         ///< the disk
  int lost_after = 1 << 30;         ///< a row of the log, whose folder is gone

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const&) {
    --stop_after;
    if (--die_after == 0) throw Killed{};
    if (--full_after == 0) limit_files(64);
  }
  bool wants_stop() const { return stop_after <= 0 || --questions <= 0; }

  SCARP_MEMBERS_EXCEPT((stop_after, die_after, questions, full_after, lost_after))
};

/// Takes a budget's place when there is none.
struct Budget : scarp::NeverStops {
  std::optional<scarp::ErrorBudget<Block::Problem>> own{};

  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& report) {
    if (own) own->attempted(problem, report);
  }
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    if (self.own) visit("budget", *self.own);
  }
};

struct Notes {
  double settled_residual = -1.0;
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("settled_residual", self.settled_residual);
  }
};

struct Outcome {
  scarp::RunReport report;
  std::optional<samples::Committed<Block::Problem>> state;
  Notes notes;
  std::string log;
  std::vector<double> budget;
  std::string trouble;
};

/// A softening block that is settled, pulled with refused steps on the way, and pulled on nearly to its peak, by
/// objects that are all made anew.
Outcome pull(ScratchFolder const& folder, scarp::CheckpointFiles files, Ending ending, bool has_budget = true) {
  scarp::SerialExecutor serial;
  auto problem = Block::make({.reference_strain = 0.02, .largest_increment = 4e-3}, serial);
  auto const start = files.resumes() ? scarp::CsvStart::resumed : scarp::CsvStart::anew;
  Outcome outcome;
  Budget budget;
  if (has_budget) budget.own.emplace(problem, scarp::ErrorBounds{}, scarp::ErrorSampling{.points_per_tracked = 8});
  scarp::Observers observers(
      LoadLog{{}, {folder / "log.csv", {"step", "load", "residual", "reason"}, start}, ending.lost_after},
      std::ref(budget), ending);
  scarp::CheckpointedRun run(files, observers, outcome.notes);
  scarp::QuasiNewton<> const solver{.tolerance = 1e-6};
  scarp::LoadStepping const stepping{
      .first = 1e-3, .smallest = 1e-6, .largest = 4e-3, .max_displacement_gradient = 0.1};
  run.stage([&] {
    auto const report = stepping.settle(solver, problem, 0.0, run);
    outcome.notes.settled_residual = 0.25;
    return report;
  });
  run.stage([&] { return stepping.run(solver, problem, 0.0, 0.012, run); });
  run.stage([&] { return stepping.run(solver, problem, 0.012, 0.016, run); });
  outcome.report = run.report();
  outcome.trouble = run.trouble();
  outcome.state.emplace(problem);
  outcome.log = content(folder / "log.csv");
  if (has_budget) {
    for (auto const& part : budget.own->parts()) outcome.budget.push_back(part.value);
  }
  return outcome;
}

scarp::CheckpointFiles resumed(ScratchFolder const& folder, std::string text = scene) {
  return {{.folder = folder / "states", .resume = true, .every_seconds = 1e9}, std::move(text)};
}

Outcome const& undisturbed() {
  static Outcome const made = [] {
    ScratchFolder const folder;
    return pull(folder, {}, {});
  }();
  return made;
}

/// One of two processes, which has every other point.
struct EvenPoints : scarp::SerialExecutor {
  bool owns(int point) const override { return point % 2 == 0; }
  std::string fetch(int) const override { return {}; }
};

/// Points that know only whether they have a state here.
struct SharedOut {
  struct Points {
    std::vector<bool> present{true, false, true, false};
    int size() const { return static_cast<int>(present.size()); }
    void release(int point) { present[static_cast<std::size_t>(point)] = false; }
    void unpack(int point, std::string const&) { present[static_cast<std::size_t>(point)] = true; }
    static std::string pack(int) { return {}; }
  };
  Points all{};
  EvenPoints ranks{};

  Points& points() { return all; }
  Points const& points() const { return all; }
  EvenPoints const& executor() const { return ranks; }
};

/// Wall times aside.
void check_same(Outcome const& outcome, Outcome const& expected) {
  CHECK(outcome.report.verdict == expected.report.verdict);
  CHECK(outcome.report.last_failure == expected.report.last_failure);
  CHECK(outcome.report.load == expected.report.load);
  CHECK(outcome.report.steps == expected.report.steps);
  CHECK(outcome.report.refused == expected.report.refused);
  CHECK(outcome.report.iterations == expected.report.iterations);
  CHECK(outcome.report.largest_residual == expected.report.largest_residual);
  CHECK(outcome.notes.settled_residual == expected.notes.settled_residual);
  CHECK(*outcome.state == *expected.state);
  CHECK(outcome.log == expected.log);
  CHECK(outcome.budget == expected.budget);
}

std::string complaint_about(ScratchFolder const& folder, std::string text = scene) {
  return samples::message_of<CheckpointError>([&] { static_cast<void>(resumed(folder, std::move(text))); });
}

}  // namespace

TEST_CASE("an error budget does not change a bit of the run that it watches") {
  ScratchFolder const folder;
  auto unwatched = pull(folder, {}, {}, false);
  CHECK(unwatched.budget.empty());
  CHECK(undisturbed().budget.size() > 5);
  unwatched.budget = undisturbed().budget;
  check_same(unwatched, undisturbed());
}

TEST_CASE("a run that is stopped before every attempt and continued by new objects keeps its bits") {
  REQUIRE(undisturbed().report.verdict.acceptable());
  REQUIRE(undisturbed().report.refused > 0);
  ScratchFolder const folder;
  Outcome outcome;
  int parts = 0;
  do {
    outcome = pull(folder, resumed(folder), {.stop_after = 1});
    ++parts;
  } while (outcome.report.verdict.reason == scarp::Reason::interrupted && parts < 100);
  check_same(outcome, undisturbed());
  // The step that settles begins without a question; every other attempt is a part, and the first stage's end makes one
  // more at most.
  int const attempts = undisturbed().report.steps + undisturbed().report.refused;
  CHECK(attempts > 10);
  CHECK(parts >= attempts - 1);
}

TEST_CASE(
    "a run that is stopped within its attempts and continued keeps its bits, and an attempt that was cut short never "
    "was") {
  std::set<int> attempts;
  for (int questions = 1; questions < 60; questions += 4) {
    CAPTURE(questions);
    ScratchFolder const folder;
    auto const stopped = pull(folder, resumed(folder), {.questions = questions});
    CHECK(stopped.report.verdict.reason == scarp::Reason::interrupted);
    attempts.insert(stopped.report.steps + stopped.report.refused);
    check_same(pull(folder, resumed(folder), {}), undisturbed());
  }
  CHECK(attempts.size() > 3);
  CHECK(attempts.size() < 15);  // some have ended within the same attempt
}

TEST_CASE("rows that were written after the last checkpoint vanish when a killed run goes on") {
  int const attempts = undisturbed().report.steps + undisturbed().report.refused;
  for (int last = 2; last < attempts; last += 3) {
    CAPTURE(last);
    ScratchFolder const folder;
    scarp::CheckpointSettings settings{.folder = folder / "states", .every_seconds = 1e9, .every_attempts = 4};
    CHECK_THROWS_AS(pull(folder, {settings, scene}, {.die_after = last}), Killed);
    CHECK(resumed(folder).resumes() == (last > 4));
    // One cut off in the middle is no obstacle either.
    std::ofstream(folder / "log.csv", std::ios::app) << "99,0.0";
    check_same(pull(folder, resumed(folder), {}), undisturbed());
  }
}

TEST_CASE(
    "a run whose disk is full stops with what it could not write, and goes on to the same bits when there is room") {
  for (int const attempts : {1, 6, 11}) {
    CAPTURE(attempts);
    ScratchFolder const folder;
    scarp::CheckpointSettings const settings{.folder = folder / "states", .every_seconds = 1e9, .every_attempts = 1};
    auto const stopped = pull(folder, {settings, scene}, {.full_after = attempts});
    limit_files(RLIM_INFINITY);
    CHECK(stopped.report.verdict.reason == scarp::Reason::interrupted);
    CHECK(contains(stopped.trouble, "cannot write"));
    CHECK(contains(stopped.trouble, "File too large"));
    check_same(pull(folder, resumed(folder), {}), undisturbed());
  }
}

TEST_CASE("a row that could not be written is written when the run goes on, though a checkpoint had room") {
  for (int const attempts : {1, 6, 11}) {
    CAPTURE(attempts);
    ScratchFolder const folder;
    scarp::CheckpointSettings const settings{.folder = folder / "states", .every_seconds = 1e9, .every_attempts = 2};
    auto const stopped = pull(folder, {settings, scene}, {.lost_after = attempts});
    CHECK(stopped.report.verdict.reason == scarp::Reason::interrupted);
    CHECK(stopped.trouble == "cannot write 'log.csv'");
    check_same(pull(folder, resumed(folder), {}), undisturbed());
  }
}

TEST_CASE("two checkpoints are kept, and a run afresh does not replace them") {
  ScratchFolder const folder;
  scarp::CheckpointSettings const settings{.folder = folder / "states", .every_seconds = 0.0};
  static_cast<void>(pull(folder, {settings, scene}, {}));
  std::vector<std::string> names;
  for (auto const& file : std::filesystem::directory_iterator(folder / "states"))
    names.push_back(file.path().filename().string());
  CHECK(names.size() == 2);
  CHECK_THROWS_WITH_AS(scarp::CheckpointFiles(settings, scene),
                       doctest::Contains("holds checkpoints of an earlier run"), CheckpointError);
  check_same(pull(folder, resumed(folder), {}), undisturbed());  // of a run that has ended: nothing is left to do
}

TEST_CASE("a checkpoint of another scene, version or machine is refused with the reason, and so is a damaged one") {
  ScratchFolder const folder;
  CHECK_FALSE(resumed(folder).resumes());  // there is none
  scarp::CheckpointSettings const settings{.folder = folder / "states", .every_seconds = 0.0};
  static_cast<void>(pull(folder, {settings, scene}, {.stop_after = 4}));
  auto const newest = resumed(folder).newest();
  CHECK(contains(complaint_about(folder, "size = 1\nseed = 8\n"),
                 newest.string() + "': it is of another scene ('seed = 7' there, 'seed = 8' here)"));
  CHECK(contains(complaint_about(folder, "size = 1\n"), "('seed = 7' there, '' here)"));
  CHECK_FALSE(contains(complaint_about(folder, "size = 1\n"), "newest"));  // a good checkpoint is not to be given up
  auto const bytes = content(newest);
  auto const complaint = [&](auto change) {
    auto harmed = bytes;
    change(harmed);
    scarp::write_file(newest, harmed);
    return complaint_about(folder);
  };
  CHECK(contains(complaint([](auto& harmed) {
                   auto& byte = harmed[harmed.size() / 2];
                   byte = static_cast<char>(byte ^ 1);
                 }),
                 "its bytes have changed"));
  CHECK(contains(complaint([](auto& harmed) { harmed.resize(harmed.size() / 2); }), "it was cut off"));
  CHECK(contains(complaint([](auto& harmed) { harmed.resize(5); }), "it is no checkpoint"));
  CHECK(contains(complaint([](auto& harmed) { harmed[12] = 99; }), "it is of version"));
  CHECK(contains(complaint([](auto& harmed) { std::reverse(harmed.begin() + 8, harmed.begin() + 12); }),
                 "its order of bytes"));
  auto const text = complaint([](auto& harmed) { harmed.clear(); });
  std::size_t const named = text.find("the one before is '");
  REQUIRE(named != std::string::npos);
  std::filesystem::rename(newest, folder / "moved");  // as the complaint advises
  CHECK(contains(text, resumed(folder).newest().string()));
  check_same(pull(folder, resumed(folder), {}), undisturbed());
}

TEST_CASE("a checkpoint is refused by a scene of another size and by one whose tables have lost rows") {
  ScratchFolder const folder;
  static_cast<void>(pull(folder, resumed(folder), {.stop_after = 6}));
  std::vector<scarp::VoigtStress<2>> few(3);
  CHECK_THROWS_WITH_AS(resumed(folder).load([&](scarp::StateReader& reader) { reader("stage", few); }),
                       doctest::Contains("it has 'stage' of 4 bytes where 'stage' of 24 bytes should be"),
                       CheckpointError);
  scarp::StateWriter writer;
  writer("states", few);
  scarp::StateReader reader(writer.bits());
  few.resize(2);
  CHECK_THROWS_WITH_AS(reader("states", std::span(few)), doctest::Contains("it has 3 'states' (the scene has 2)"),
                       scarp::InputError);
  constexpr std::string_view few_rows = "step,load,residual,reason\n1,";
  scarp::write_file(folder / "log.csv", few_rows);
  CHECK_THROWS_WITH_AS(pull(folder, resumed(folder), {}), doctest::Contains("log.csv' has 28 bytes (it had "),
                       CheckpointError);
  CHECK(content(folder / "log.csv") == few_rows);  // a refusal touches nothing
  std::filesystem::remove(folder / "log.csv");
  CHECK_THROWS_WITH_AS(pull(folder, resumed(folder), {}), doctest::Contains("log.csv' has 0 bytes"), CheckpointError);
  CHECK_FALSE(std::filesystem::exists(folder / "log.csv"));
}

TEST_CASE("states of other processes are let go again, also where a checkpoint cannot be written") {
  SharedOut problem;
  std::vector<bool> const own = problem.all.present;
  scarp::with_all_states(problem, [&] { CHECK(problem.all.present == std::vector<bool>(4, true)); });
  CHECK(problem.all.present == own);
  CHECK_THROWS_AS(scarp::with_all_states(problem, [] { throw scarp::FileError("the disk is full"); }),
                  scarp::FileError);
  CHECK(problem.all.present == own);
}

TEST_CASE("a stage with two paths of the load factor is refused before it has done harm") {
  scarp::SerialExecutor serial;
  auto problem = Block::make({}, serial);
  scarp::Observers<> observers;
  Notes notes;
  scarp::CheckpointFiles files;
  scarp::CheckpointedRun run(files, observers, notes);
  scarp::LoadStepping const stepping{.first = 1e-4};
  auto const path = [&](double from) { return stepping.run(scarp::QuasiNewton<>{}, problem, from, from + 1e-4, run); };
  run.stage([&] {
    auto const first = path(0.0);
    CHECK_THROWS_WITH_AS(static_cast<void>(path(1e-4)), doctest::Contains("a stage has two paths"), scarp::InputError);
    return first;
  });
  run.stage([&] { return path(1e-4); });
  CHECK(run.report().verdict.acceptable());
}

TEST_CASE("a checkpoint that holds more than the scene remembers is refused") {
  ScratchFolder const folder;
  static_cast<void>(pull(folder, {{.folder = folder / "states", .every_seconds = 1e9}, scene}, {.stop_after = 6}));
  CHECK(samples::message_of<CheckpointError>([&] { pull(folder, resumed(folder), {}, false); }) ==
        samples::Naming{"holds more than the scene"});
}

#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
/// Memory in use [bytes] when so many steps have been attempted.
struct MemoryInUse : scarp::NeverStops {
  std::vector<int> attempts;
  std::vector<std::size_t>* bytes;
  int seen = 0;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const&) {
    if (std::ranges::count(attempts, ++seen) == 0) return;
    auto const now = ::mallinfo2();
    bytes->push_back(now.uordblks + now.hblkhd);
  }
  SCARP_MEMBERS_EXCEPT((attempts, bytes, seen))
};

TEST_CASE("a run of three hundred steps holds no more memory than one of thirty") {
  ScratchFolder const folder;
  scarp::SerialExecutor serial;
  auto problem = Block::make({}, serial);
  Budget budget;
  budget.own.emplace(problem, scarp::ErrorBounds{}, scarp::ErrorSampling{.points_per_tracked = 8});
  std::vector<std::size_t> bytes;
  bytes.reserve(2);
  scarp::Observers observers(LoadLog{{}, {folder / "log.csv", {"step", "load", "residual", "reason"}}},
                             std::ref(budget), MemoryInUse{{}, {30, 300}, &bytes});
  Notes notes;
  scarp::CheckpointFiles files;
  scarp::CheckpointedRun run(files, observers, notes);
  scarp::LoadStepping const stepping{.first = 1e-5, .smallest = 1e-6, .largest = 1e-5};
  run.stage([&] { return stepping.run(scarp::QuasiNewton<>{}, problem, 0.0, 0.0031, run); });
  REQUIRE(bytes.size() == 2);
  if (bytes[0] == 0) return;  // a sanitizer has replaced the allocator
  // Less than a number a step.
  CHECK(bytes[1] < bytes[0] + 2048);
}
#endif

// A checkpoint on somebody's disk, not one that this program has just written. Where a saved type or the format's
// version changes, raise the version; this command writes the new one, and the old one stays to be refused:
// SCARP_STORE=1 ctest --test-dir build -R runs/checkpointed_run
TEST_CASE(
    "a checkpoint that was stored is continued, or refused with its version where the format has another one now") {
  auto const stored = std::filesystem::path(__FILE__).parent_path() / "../reference/stored";
  auto const newest = fmt::format("run_{}", scarp::detail::checkpoint_format.version);
  if (std::getenv("SCARP_STORE") != nullptr) {
    ScratchFolder const folder;
    static_cast<void>(pull(folder, {{.folder = folder / "states", .every_seconds = 1e9}, scene}, {.stop_after = 4}));
    std::filesystem::create_directories(stored);
    std::filesystem::copy(folder.path(), stored / newest, std::filesystem::copy_options::recursive);
  }
  REQUIRE(std::filesystem::exists(stored / newest));
  for (auto const& run : std::filesystem::directory_iterator(stored)) {
    if (!run.is_directory()) continue;
    ScratchFolder const folder;
    std::filesystem::copy(run.path(), folder.path(), std::filesystem::copy_options::recursive);
    if (run.path().filename() == newest) {
      auto const outcome = pull(folder, resumed(folder), {});
      // Not its bits: the standard library's functions differ in the last one.
      CHECK(outcome.report.verdict.acceptable());
      CHECK(outcome.report.steps == undisturbed().report.steps);
      CHECK(outcome.report.load == undisturbed().report.load);
      CHECK(std::ranges::count(outcome.log, '\n') == std::ranges::count(undisturbed().log, '\n'));
    } else {
      CHECK(contains(complaint_about(folder), "it is of version"));
    }
  }
}

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>
#include <utility>

#include "scarp/io/checkpoint_files.hpp"
#include "scarp/run/root_rank.hpp"
#include "scarp/solver/load_stepping.hpp"

namespace scarp {

/// Leaves only the states of points that this process owns.
template <class Problem>
void keep_own_states(Problem& problem) {
  for (int point = 0; point < problem.points().size(); ++point) {
    if (!problem.executor().owns(point)) problem.points().release(point);
  }
}

/// Runs a task on the root rank, where all points have their committed states as long as it lasts, whatever it
/// throws; the other ranks send theirs.
template <class Problem, class Task>
void with_all_states(Problem& problem, Task const& task) {
  on_root_rank(problem, [&] {
    try {
      for (int point = 0; point < problem.points().size(); ++point) {
        if (!problem.executor().owns(point)) problem.points().unpack(point, problem.executor().fetch(point));
      }
      task();
    } catch (...) {
      keep_own_states(problem);
      throw;
    }
    keep_own_states(problem);
  });
}

/// A run in stages that can be killed at any moment and resumes from its last checkpoint with the same bits. It watches
/// the stages in place of other observers, which it passes everything on to and whose memory it saves too:
/// \code
/// CheckpointFiles files({.folder = "states", .resume = true}, "size = 2.5\nseed = 1\n");
/// Observers observers(...);  // logs are CsvStart::resumed where files.resumes()
/// CheckpointedRun run(files, observers, notes);
/// run.stage([&] { return scene.settle(problem, run); });
/// run.stage([&] { return scene.rupture(problem, run); });
/// \endcode
/// Stages before that of the checkpoint are left out; the problem that it is loaded into is a new one of the same
/// scene. A checkpoint is made before an attempt when its time has come, where a stage by run() or advance() ends, and
/// where that stops: with the last accepted state then. When something cannot be written, by an observer or of a
/// checkpoint, the run stops there as when it is interrupted, trouble() returns the message, and the checkpoint before
/// remains: the steps after it are made anew, for all observers. Where points are distributed over processes, the first
/// one writes for all and each reads all: another number of processes may resume.
/// \tparam Watched an `ObservesSteps` that is `Described`, such as `Observers`
template <class Watched, Described Notes>
class CheckpointedRun {
 public:
  using WatchesAll = void;  ///< `Observers` reject it as a part

  /// notes: the program's own data of earlier stages
  /// \throws CheckpointError
  CheckpointedRun(CheckpointFiles& files, Watched& watched, Notes& notes)
      : files_(files), watched_(watched), notes_(notes), saved_(Clock::now()) {
    if (files_.resumes()) {
      files_.load([&](StateReader& reader) { read_place(reader); });
      first_ = stage_;
    }
    stage_ = -1;
  }

  /// action() goes through a stage, one path of the load factor, watched by this object, and returns its RunReport.
  /// Left out when a stage before it was not completed, or when a checkpoint lies behind it.
  template <class Action>
  void stage(Action&& action) {
    ++stage_;
    if (stage_ >= first_ && report_.verdict.acceptable()) report_ = joined(report_, action());
  }

  /// The report of all stages so far.
  RunReport const& report() const { return report_; }

  /// Passes an attempt on to the observers; a file that cannot be written stops the run.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& step) {
    ++attempts_;
    writing(problem, [&] { watched_.attempted(problem, step); });
  }
  /// Whether a file could not be written or an observer stops the run.
  bool wants_stop() const { return stopped_ || watched_.wants_stop(); }

  /// What could not be written; on the root rank, empty where there is nothing of the kind.
  std::string const& trouble() const { return trouble_; }
  /// Whether a rank has such trouble.
  bool stopped() const { return stopped_; }

  /// Loads the checkpoint into the stage that it was made in.
  /// \throws CheckpointError for a checkpoint of another scene, InputError for a second path within a stage
  template <class Problem, class Session>
  void begins(Problem& problem, Session& session, RunState& state) {
    if (std::exchange(begun_, stage_) == stage_)
      reject("a stage has two paths of the load factor (a checkpoint belongs to one): make each a stage of its own");
    if constexpr (requires { problem.require_described(); }) {
      if (files_.saves()) problem.require_described();
    }
    if (!files_.resumes() || stage_ != first_) return;
    files_.load([&](StateReader& reader) {
      read_place(reader);
      members(*this, problem, session, state, reader);
      // The observers' memory is for the root rank alone.
      if (is_root_rank(problem.executor()) && !reader.at_end())
        reject("it holds more than the scene has: load it into the scene that was saved");
    });
    files_.release();
    keep_own_states(problem);
    if (state.report.verdict.reason == Reason::interrupted) state.report.verdict = {};
  }

  /// Makes a checkpoint where it is due by time or number of attempts.
  template <class Problem, class Session>
  void between(Problem& problem, Session const& session, RunState const& state) {
    auto const& settings = files_.settings();
    double const seconds = std::chrono::duration<double>(Clock::now() - saved_).count();
    bool const due =
        seconds >= settings.every_seconds || (settings.every_attempts > 0 && attempts_ >= settings.every_attempts);
    if (problem.executor().agree(due) && attempts_ > 0) save(problem, session, state);
  }

  /// Makes a checkpoint of the state that a stage ends in, unless it has just been made.
  template <class Problem, class Session>
  void ends(Problem& problem, Session const& session, RunState const& state) {
    if (attempts_ > 0) save(problem, session, state);
  }

 private:
  using Clock = std::chrono::steady_clock;

  template <class Problem, class Session>
  void save(Problem& problem, Session const& session, RunState const& state) {
    if (!files_.saves() || stopped_) return;  // some have missed the last step, or no file can be written
    writing(problem, [&] {
      with_all_states(problem, [&] {
        files_.save([&](StateWriter& writer) {
          writer("stage", stage_);
          writer("earlier stages", report_);
          members(std::as_const(*this), std::as_const(problem), session, state, writer);
        });
      });
    });
    attempts_ = 0;
    saved_ = Clock::now();
  }

  template <class Problem, class Action>
  void writing(Problem const& problem, Action const& action) {
    std::exception_ptr elsewhere;
    try {
      action();
    } catch (FileError const& problem_of_file) {
      if (trouble_.empty()) trouble_ = problem_of_file.what();
    } catch (InputError const&) {  // on other ranks perhaps for a file of the root
      if (is_root_rank(problem.executor())) throw;
      elsewhere = std::current_exception();
    }
    stopped_ = problem.executor().agree(!trouble_.empty());
    if (elsewhere && !stopped_) std::rethrow_exception(elsewhere);
  }

  void read_place(StateReader& reader) {
    reader("stage", stage_);
    reader("earlier stages", report_);
  }

  template <class Self, class Problem, class Session, class State, class Visit>
  static void members(Self& self, Problem& problem, Session& session, State& state, Visit& visit) {
    visit("problem", problem);
    visit("session", session);
    visit("state", state);
    visit("notes", self.notes_);
    visit("observers", self.watched_);
  }

  CheckpointFiles& files_;
  Watched& watched_;
  Notes& notes_;
  RunReport report_;  ///< of the stages before the present one
  int stage_ = -1;
  int first_ = 0;     ///< stage to begin with
  int begun_ = -2;    ///< stage whose path has begun last
  int attempts_ = 0;  ///< since the last checkpoint
  Clock::time_point saved_;
  std::string trouble_;
  bool stopped_ = false;
};

}  // namespace scarp

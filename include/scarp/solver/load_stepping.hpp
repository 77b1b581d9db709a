// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

/// Watches a run: called after every attempt at a step, accepted or not; may stop the run, before an attempt or within
/// one, which then counts as never made.
template <class Observer, class Problem>
concept ObservesSteps = requires(Observer& observer, Problem const& problem, StepReport const& report) {
  observer.attempted(problem, report);
  { observer.wants_stop() } -> std::convertible_to<bool>;
};

namespace detail {
/// Names the missing member of a type that is no `ObservesSteps`.
template <class Observer, class Problem>
consteval bool check_observer() {
  static_assert(
      requires(Observer & observer, Problem const& problem, StepReport const& report) {
        observer.attempted(problem, report);
      },
      "scarp: an observer needs `void attempted(problem const&, StepReport const&)`, called after every attempt at a "
      "step");
  static_assert(
      requires(Observer & observer) {
        { observer.wants_stop() } -> std::convertible_to<bool>;
      },
      "scarp: an observer needs `bool wants_stop()`");
  return ObservesSteps<Observer, Problem>;
}
}  // namespace detail

/// An `ObservesSteps`; for another type the compiler names the missing member.
template <class Observer, class Problem>
concept CheckedObserver = detail::check_observer<Observer, Problem>();

/// An observer that records nothing and never stops a run.
struct NoObserver {
  template <class Problem>
  void attempted(Problem const&, StepReport const&) {}  ///< Records nothing.
  bool wants_stop() const { return false; }             ///< Never stops a run.
};

/// Where a run stands between two attempts: with the problem and the session it is all that the rest of the run follows
/// from.
struct RunState {
  RunReport report;        ///< of the run so far
  double increment = 0.0;  ///< of the load, for the next attempt

  SCARP_MEMBERS(report, increment)
};

/// An observer that saves runs and continues saved ones: begins(problem, session, state), before the first attempt, may
/// put back what was saved; between(...) is called before every attempt and ends(...) after the last one where the run
/// stands.
template <class Observer, class Problem, class Session>
concept KeepsRuns = ObservesSteps<Observer, Problem> &&
    requires(Observer& observer, Problem& problem, Session& session, RunState& state) {
  observer.begins(problem, session, state);
  observer.between(problem, session, state);
  observer.ends(problem, session, state);
};

/// Raises the load factor in steps that adapt themselves: the prediction's largest displacement gradient limits a step
/// before it is tried, few iterations let the next one grow, many make it shrink, and a failed one is rolled back and
/// halved. A step ends at the knots of loads and prescribed motions, so that no peak is passed by. Only a step whose
/// residual and points are all acceptable is committed. A field that estimates its error in time, such as `PoreWater`
/// with `largest_time_error`, limits steps too: one step has an error of second order, so that the next one is at most
/// as long as this one times \f$ 0.9/\sqrt{e} \f$, e being the error over the allowed one. A step of e > 1 is rolled
/// back and repeated with 0.9/e of its length, a tenth at least: after a sudden change the estimate is of first order.
struct LoadStepping {
  double first = 1e-3;                      ///< load increment of the first step
  double smallest = 1e-7;                   ///< increment below which the run gives up
  double largest = 1e300;                   ///< increment that no step exceeds
  double max_displacement_gradient = 0.01;  ///< of the prediction at any point
  double growth = 1.4;                      ///< after at most `grow_below` iterations
  int grow_below = 6;                       ///< iterations up to which the increment grows
  double shrinkage = 0.75;                  ///< after more than `shrink_above` iterations
  int shrink_above = 10;                    ///< iterations beyond which the increment shrinks

  /// \throws InputError for a setting outside of its range
  void validate() const {
    require_positive("smallest load increment", smallest);
    require_positive("first load increment", first);
    require_at_least("first load increment", first, smallest);
    require_at_least("largest load increment", largest, smallest);
    require_positive("largest gradient of a load step", max_displacement_gradient);
    require_between("growth of the load increment", growth, 1.0, std::numeric_limits<double>::max());
    require_positive("shrinkage of the load increment", shrinkage);
    require_between("shrinkage of the load increment", shrinkage, 0.0, 1.0);
    require_at_least("iterations up to which the load increment grows", grow_below, 0);
    require_at_least("iterations beyond which the load increment shrinks", shrink_above, grow_below);
  }

  /// One step without growth of the load: brings a prepared state into equilibrium, or returns the reason.
  template <class Solver, class Problem, class Observer>
    requires CheckedObserver<Observer, Problem> RunReport settle(Solver const& solver, Problem& problem, double load,
                                                                 Observer& observer)
  const {
    validate();
    require_finite("load factor", load);
    typename Solver::template Session<Problem> session(solver, problem);
    RunReport run;
    run.load = load;
    StepReport step;
    step.load = load;
    try_step(session, problem, load, step, run, observer, [&] { return session.predict(load, load); });
    run.verdict = step.verdict;
    return run;
  }

  /// From load factor `from` to `to`, not below it. The problem's committed state must belong to `from`.
  /// \throws InputError for settings outside of their range, load factors that are not finite or fall
  template <class Solver, class Problem, class Observer>
    requires CheckedObserver<Observer, Problem> RunReport run(Solver const& solver, Problem& problem, double from,
                                                              double to, Observer& observer)
  const {
    typename Solver::template Session<Problem> session(solver, problem);
    return advance(session, problem, from, to, observer);
  }

  /// As advance() with a solver's session on this problem, whose learned tangents persist from one call to the next.
  template <class Session, class Problem, class Observer>
    requires CheckedObserver<Observer, Problem> RunReport advance(Session& session, Problem& problem, double from,
                                                                  double to, Observer& observer)
  const {
    validate();
    require_finite("load factor at the start", from);
    require_finite("load factor at the end", to);
    if (to < from)
      reject("the load factor is to go from {} to {} (it can only grow): let an amplitude fall while it grows", from,
             to);
    RunState state;
    state.report.load = from;
    state.increment = std::min({first, largest, to - from});
    if constexpr (KeepsRuns<Observer, Problem, Session>) observer.begins(problem, session, state);
    while (state.report.verdict.acceptable() && state.report.load < to) {
      if constexpr (KeepsRuns<Observer, Problem, Session>) observer.between(problem, session, state);
      if (observer.wants_stop()) {
        state.report.verdict = {Status::not_converged, Reason::interrupted};
      } else {
        attempt(session, problem, to, state, observer);
      }
    }
    if constexpr (KeepsRuns<Observer, Problem, Session>) observer.ends(problem, session, state);
    return state.report;
  }

 private:
  /// One step, accepted or not; the increment of the next.
  template <class Session, class Problem, class Observer>
  void attempt(Session& session, Problem& problem, double to, RunState& state, Observer& observer) const {
    RunReport& run = state.report;
    double& increment = state.increment;
    double const round_off = 1e-14 * std::max(1.0, std::abs(run.load));  // knots of two courses are one knot
    double const goal = std::min(to, next_knot(problem, run.load + round_off));
    double tried = std::min(increment, goal - run.load);
    bool const is_cut = tried < increment;
    StepReport step;
    step.step = run.steps + 1;
    step.load = run.load;
    bool const began = try_step(session, problem, end_of(run.load, goal, tried), step, run, observer, [&] {
      Eigen::VectorXd displacement = limited_prediction(session, problem, run.load, goal, tried);
      step.load = end_of(run.load, goal, tried);
      step.load_increment = step.load < goal ? tried : goal - run.load;
      return displacement;
    });
    if (!began || step.interrupted()) {  // a smaller increment cannot correct tangents or matrix
      run.verdict = step.verdict;
      return;
    }
    if (step.verdict.acceptable()) {
      // A step that a knot has cut short leaves the next one as long as it was to be.
      if (!is_cut || step.load < goal) increment = step.iterations() <= grow_below ? tried * growth : tried;
      if (step.iterations() > shrink_above) increment *= shrinkage;
      if (step.time_error > 0.0) increment = std::min(increment, tried * 0.9 / std::sqrt(step.time_error));
    } else {
      increment = tried * (step.verdict.reason == Reason::time_error ? std::max(0.9 / step.time_error, 0.1) : 0.5);
      if (increment < smallest) {
        run.verdict = {Status::not_converged, Reason::step_too_small};
        return;
      }
    }
    increment = std::min({increment, largest, std::max(to - run.load, smallest)});
  }

  /// First load factor beyond one where loads or prescribed motions may turn; infinite for a problem that names none.
  template <class Problem>
  static double next_knot(Problem const& problem, double load) {
    if constexpr (requires { problem.next_knot(load); }) return problem.next_knot(load);
    return std::numeric_limits<double>::infinity();
  }

  /// From the committed state at the step's load to equilibrium at what predict() begins with, which is at the load
  /// `aim` or before; an interrupted attempt counts as never made.
  /// \return whether the session could begin
  template <class Session, class Problem, class Observer, class Predict>
  static bool try_step(Session& session, Problem const& problem, double aim, StepReport& step, RunReport& run,
                       Observer& observer, Predict const& predict) {
    auto const started = std::chrono::steady_clock::now();
    Eigen::VectorXd displacement;
    step.verdict = session.begin(step.load, aim);
    session.describe(step);
    bool const began = step.verdict.acceptable();
    if (began) {
      displacement = predict();
      session.correct(displacement, step, [&] { return observer.wants_stop(); });
      if (step.interrupted()) return true;
      judge_time(problem, step);
    }
    step.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    bool const accepted = step.verdict.acceptable();
    if (accepted) session.accept(displacement);
    count(run, step, accepted);
    observer.attempted(problem, step);
    return began;
  }

  /// Rejects a step in equilibrium whose error in time is larger than allowed.
  template <class Problem>
  static void judge_time(Problem const& problem, StepReport& step) {
    if constexpr (requires { problem.time_error(); }) {
      if (!step.verdict.acceptable()) return;
      step.time_error = problem.time_error();
      if (!(step.time_error <= 1.0)) step.verdict = {Status::not_converged, Reason::time_error};
    }
  }

  /// Cuts the increment until the prediction strains no point more than allowed; the prediction is nearly linear in it.
  template <class Session, class Problem>
  Eigen::VectorXd limited_prediction(Session& session, Problem& problem, double load, double to,
                                     double& increment) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (;;) {
      Eigen::VectorXd const displacement = session.predict(load, end_of(load, to, increment));
      Verdict const planned = problem.plan(displacement);
      if (planned.reason == Reason::not_finite) return displacement;
      // A prediction that turns an element inside out has no gradient.
      double const ratio =
          planned.acceptable() ? problem.max_displacement_gradient() / max_displacement_gradient : infinite;
      // Part of a prediction may come from the present imbalance, which no smaller increment removes.
      if (!(ratio > 1.001) || increment < 2.0 * smallest) return displacement;
      increment = std::max(increment * std::max(1.0 / ratio, 0.3), smallest);
      // What a field lacks at the end of a step is part of its linear system.
      if constexpr (requires { session.begins_at_end(); }) {
        if (session.begins_at_end() && !session.begin(load, end_of(load, to, increment)).acceptable())
          return displacement;
      }
    }
  }

  /// Load factor that a step ends at; one that would leave less than the smallest increment goes to the end.
  double end_of(double load, double to, double increment) const {
    return to - load - increment < smallest ? to : load + increment;
  }

  static void count(RunReport& run, StepReport const& step, bool accepted) {
    run.iterations += step.iterations();
    for (auto const& record : step.history) {
      run.inner_steps += record.inner_steps;
      run.material_seconds += record.material_seconds;
    }
    run.seconds += step.seconds;
    if (accepted) {
      ++run.steps;
      run.load = step.load;
      run.largest_residual = std::max(run.largest_residual, step.residual());
    } else {
      ++run.refused;
      run.last_failure = step.verdict.reason;
      run.worst_point = step.worst_point;
      run.weak_dof = step.weak_dof;
    }
  }
};

}  // namespace scarp

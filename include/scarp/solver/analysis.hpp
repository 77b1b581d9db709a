// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/model.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace scarp {

/// How an `Analysis` goes through its load factor. Who names a member of `stepping` gives the others the defaults of
/// `LoadStepping`: name `largest` too.
struct AnalysisSettings {
  QuasiNewton<> solver{};                                                  ///< of each load step
  LoadStepping stepping{.first = 0.05, .smallest = 1e-4, .largest = 0.1};  ///< of the load factor
  int threads = 0;                                                         ///< 0: as many as the process may use
};

/// A `Model` on its way: a problem, a solver and threads. The load factor begins at 0 and only grows.
/// \code
/// Analysis analysis(model, {.solver = {.tolerance = 1e-3}});
/// FieldSeries series("output/slope", {.to = 1.0, .count = 4});
/// RunReport const run = analysis.to(1.0, series);
/// if (!run.verdict.acceptable()) fmt::print(stderr, "{}\n", analysis.why(run));
/// fmt::print("{} m, {} N\n", analysis.displacement("crest", 1), analysis.reaction("bottom").y());
/// \endcode
template <int Dim>
class SCARP_EXPORT Analysis {
 public:
  static constexpr int dim = Dim;       ///< of space
  using Problem = scarp::Problem<Dim>;  ///< what solvers and observers get

  /// \throws InputError when the model's parts do not fit together
  explicit Analysis(Model<Dim> const& model, AnalysisSettings const& settings = {});

  Problem const& problem() const { return problem_; }  ///< Mesh, points, committed state.
  Problem& problem() { return problem_; }              ///< For callers that change states between stages.
  double load() const { return load_; }                ///< Load factor of the committed state.

  /// Raises the load factor, watched by an observer.
  /// \return how far it came
  template <class Observer>
  RunReport to(double load, Observer& observer) {
    static_assert(
        !requires { typename Observer::WatchesAll; },
        "scarp: a CheckpointedRun restores a session of its own: use LoadStepping with model.problem()");
    Follower<Observer> follower{observer, load_};
    return settings_.stepping.advance(session_, problem_, load_, load, follower);
  }
  RunReport to(double load);  ///< Without an observer.

  /// Displacement [m] of a boundary's node that has moved farthest along an axis, with its sign.
  /// \throws InputError for an unknown boundary or axis
  double displacement(std::string_view side, int axis) const;
  double displacement(typename Model<Dim>::Names, int) const = delete;  // two names in braces would be read as one

  /// Force [N] of the support of a boundary: what its nodes carry, of ground and of what is attached, less their loads.
  /// Below the load factor 1 it is that of ground which was in equilibrium at first, so that the whole weight counts;
  /// of ground that was without stress, the part of the weight that acts.
  /// \throws InputError for an unknown boundary
  Vector<Dim> reaction(std::string_view side) const;
  Vector<Dim> reaction(typename Model<Dim>::Names) const = delete;

  /// A run's end in words: where it stopped and why the last attempt was rejected.
  std::string why(RunReport const& run) const;

  /// What evolves: an analysis of the same model and settings that reads it resumes with the same bits.
  SCARP_MEMBERS_EXCEPT((settings_, executor_, external_), problem_, session_, load_)

 private:
  /// Knows the load factor of the committed state, whatever an observer throws.
  template <class Observer>
  struct Follower {
    Observer& observer;
    double& load;

    void attempted(Problem const& problem, StepReport const& report) {
      if (report.verdict.acceptable()) load = report.load;
      observer.attempted(problem, report);
    }
    bool wants_stop() const { return observer.wants_stop(); }
  };

  AnalysisSettings settings_;
  ThreadExecutor executor_;
  Problem problem_;
  LoadHistory external_;
  typename QuasiNewton<>::template Session<Problem> session_;
  double load_ = 0.0;
};

// Outside of the class, so that a library can contain them.

template <int Dim>
Analysis<Dim>::Analysis(Model<Dim> const& model, AnalysisSettings const& settings)
    : settings_(settings),
      executor_(settings.threads),
      problem_(model.problem(executor_)),
      external_(model.external_loads(
          std::ranges::all_of(problem_.committed_stresses(), [](auto const& stress) { return stress.isZero(0.0); })
              ? TimeFunction::ramp(0.0, 1.0)
              : TimeFunction::constant(1.0))),
      session_(settings_.solver, problem_) {}

template <int Dim>
RunReport Analysis<Dim>::to(double load) {
  NoObserver observer;
  return to(load, observer);
}

template <int Dim>
double Analysis<Dim>::displacement(std::string_view side, int axis) const {
  if (axis < 0 || axis >= Dim)
    reject("displacements along axis {} are requested (space has the axes 0 to {}): take one of these", axis, Dim - 1);
  auto const& grid = problem_.grid();
  double farthest = 0.0;
  for (int const node : grid.boundary_nodes(side)) {
    auto const k = detail::index(node);
    double const moved = grid.positions()[k](axis) - grid.nodes()[k](axis);
    if (std::abs(moved) > std::abs(farthest)) farthest = moved;
  }
  return farthest;
}

template <int Dim>
Vector<Dim> Analysis<Dim>::reaction(std::string_view side) const {
  auto const& grid = problem_.grid();
  Eigen::VectorXd forces;
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), problem_.balanced_stresses(), forces);
  if (problem_.has_field()) forces += problem_.field()->ground_force();
  forces -= external_.at(load_);
  Vector<dim> sum = Vector<dim>::Zero();
  for (int const node : grid.boundary_nodes(side)) sum += forces.template segment<dim>(dim * node);
  return sum;
}

template <int Dim>
std::string Analysis<Dim>::why(RunReport const& run) const {
  if (run.verdict.acceptable()) return fmt::format("the load factor {:.6g} was reached", run.load);
  std::string words = fmt::format("stopped at the load factor {:.6g}: {}", run.load, name(run.verdict.reason));
  if (run.last_failure != Reason::none && run.last_failure != run.verdict.reason)
    words += fmt::format(", after {}", name(run.last_failure));
  if (run.worst_point >= 0) {
    auto const site = problem_.grid().site(run.worst_point, 0.0);
    words += fmt::format(" at point {} (region {}, at {})", run.worst_point,
                         problem_.grid().regions()[detail::index(site.region)], listed(site.position, ", ", "{:.4g}"));
  }
  if (run.weak_dof >= 0) words += ", nothing holds " + problem_.describe_dof(run.weak_dof);
  return words;
}

#ifdef SCARP_PRECOMPILED
extern template class Analysis<2>;
extern template class Analysis<3>;
#endif

}  // namespace scarp

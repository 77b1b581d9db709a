// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/constitutive/unwrap.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/solver/step_report.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// Calls visit(points, number) with points of which this process has the committed state. Where points are shared out
/// among processes, this is for the root rank, inside on_root_rank: it gets a copy of what another rank has.
template <class Problem, class Visit>
void visit_point(Problem const& problem, int point, Visit const& visit) {
  if (problem.executor().owns(point)) return visit(problem.points(), point);
  visit(problem.points().extract(point, problem.executor().fetch(point)), 0);
}

/// Cauchy stress [Pa] of a point's committed state, in the same way.
template <class Problem>
VoigtStress<Problem::dim> committed_stress(Problem const& problem, int point) {
  VoigtStress<Problem::dim> stress;
  visit_point(problem, point, [&](auto const& points, int k) { stress = points.committed_stress(k); });
  return stress;
}

/// Named numbers of the committed states of this process' points, by the executor's threads; nothing for points of
/// other processes.
template <class Problem>
std::vector<std::optional<Quantities>> own_quantities(Problem const& problem) {
  auto const& executor = problem.executor();
  std::vector<std::optional<Quantities>> values(static_cast<std::size_t>(problem.points().size()));
  executor.for_each(problem.points().size(), [&](int point) {
    if (executor.owns(point)) values[static_cast<std::size_t>(point)] = problem.points().quantities(point);
  });
  return values;
}

/// Whether this process is the first, or the only one.
inline bool is_root_rank(Executor const& executor) { return executor.rank() == 0; }

/// Runs a task on the root rank only, which may read the points of all ranks by visit_point; the others serve
/// meanwhile. What one of them throws ends all.
template <class Problem, class Task>
void on_root_rank(Problem const& problem, Task const& task) {
  problem.executor().on_first(task, [&](int point) { return problem.points().pack(point); });
}

/// Observers that live on the root rank; all ranks stop when they want to.
/// \tparam Observers an `ObservesSteps` with ended(problem, load)
template <class Observers>
class OnRootRank {
 public:
  /// make(): the observers, called on the root rank only
  template <std::invocable Make>
  OnRootRank(Executor const& executor, Make const& make) : executor_(executor) {
    executor.together([&] {
      if (is_root_rank(executor)) observers_.emplace(make());
    });
  }

  /// Passes an attempt on to the observers of the root rank; all ranks call it.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    on_root_rank(problem, [&] { observers_->attempted(problem, report); });
  }

  /// Passes the end of a stage on to the observers of the root rank; all ranks call it.
  template <class Problem>
  void ended(Problem const& problem, double load) {
    on_root_rank(problem, [&] { observers_->ended(problem, load); });
  }

  /// Whether an observer of the root rank stops the run, on every rank.
  bool wants_stop() const {
    bool flag = false;
    executor_.together([&] { flag = observers_ && observers_->wants_stop(); });
    return executor_.agree(flag);
  }

  /// The state of the observers; nothing on other ranks.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) requires Described<Observers> {
    if (self.observers_) Observers::members(*self.observers_, visit);
  }
  /// Calls that of the observers, where they have something to do then.
  void after_loading() requires requires(Observers& observers) { observers.after_loading(); }
  {
    if (observers_) observers_->after_loading();
  }

 private:
  Executor const& executor_;
  std::optional<Observers> observers_;
};

template <class Make>
OnRootRank(Executor const&, Make const&) -> OnRootRank<std::invoke_result_t<Make>>;

}  // namespace scarp

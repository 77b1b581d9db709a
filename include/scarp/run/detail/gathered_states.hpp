// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <type_traits>

#include "scarp/run/first_rank.hpp"

namespace scarp {

/// Leaves only the states of points that this process answers for.
template <class Problem>
void keep_own_states(Problem& problem) {
  using Executor = std::remove_cvref_t<decltype(problem.executor())>;
  if constexpr (SharesPoints<Executor>) {
    for (int point = 0; point < problem.materials().point_count(); ++point) {
      if (problem.executor().owns(point)) continue;
      problem.visit_field(point, [](auto& field, int local) { field.forget(local); });
    }
  }
}

/// Runs a task on the first rank, where all points have their committed states as long as it lasts; the other ranks send theirs.
template <class Problem, class Task>
void with_all_states(Problem& problem, Task const& task) {
  using Executor = std::remove_cvref_t<decltype(problem.executor())>;
  on_first_rank(problem, [&] {
    if constexpr (SharesPoints<Executor>) {
      auto const& executor = problem.executor();
      for (int point = 0; point < problem.materials().point_count(); ++point) {
        if (executor.owns(point)) continue;
        problem.visit_field(
            point, [&](auto& field, int local) { field.put(local, state_elsewhere(executor, field, point, local)); });
      }
    }
    task();
    keep_own_states(problem);
  });
}

}  // namespace scarp

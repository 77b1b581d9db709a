// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <type_traits>

#include "scarp/core/voigt.hpp"
#include "scarp/solver/executor.hpp"

namespace scarp {

/// Calls visit(provider, state) with the committed state of a point. Where points are shared out among processes, this is for the first
/// one, inside on_first_rank (run/first_rank.hpp): it gets a copy of what another one has.
template <class Problem, class Visit>
void visit_point(Problem const& problem, int point, Visit const& visit) {
  using Executor = std::remove_cvref_t<decltype(problem.executor())>;
  auto const see = [&](auto const& field, int local) {
    if constexpr (SharesPoints<Executor>) {
      if (!problem.executor().owns(point)) {
        visit(field.provider(), state_elsewhere(problem.executor(), field, point, local));
        return;
      }
    }
    visit(field.provider(), field.committed(local));
  };
  if constexpr (requires { problem.materials().committed(point); }) {
    see(problem.materials(), point);
  } else {
    problem.materials().visit(point, see);
  }
}

/// Cauchy stress [Pa] of a point's committed state.
template <class Problem>
VoigtStress<Problem::dim> committed_stress(Problem const& problem, int point) {
  using Executor = std::remove_cvref_t<decltype(problem.executor())>;
  if constexpr (SharesPoints<Executor>) {
    VoigtStress<Problem::dim> stress;
    visit_point(problem, point, [&](auto const& provider, auto const& state) { stress = provider.stress(state); });
    return stress;
  } else {
    return problem.materials().committed_stress(point);
  }
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "scarp/budget/detail/point_checks.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/worse_of.hpp"

namespace scarp {

/// How well all packings of a problem were balanced, and how fast they were strained, over its accepted steps.
struct PackingSurvey {
  double looked_at = 0.0;  ///< packings of all steps
  double unbalanced_sum = 0.0;
  double unbalanced = 0.0;  ///< largest, as the next two
  double kinetic_share = 0.0;
  double inertial_number = 0.0;

  double mean_unbalanced() const { return looked_at > 0.0 ? unbalanced_sum / looked_at : 0.0; }

  /// After an accepted step.
  template <class Problem>
  void look(Problem const& problem, std::vector<int> const& points) {
    for (int const point : points) {
      problem.materials().visit(point, [&](auto const& field, int local) {
        PackingBalance const found = point_balance(field, local, problem.gradients()[detail::index(point)]);
        if (!found.has_packing) return;
        looked_at += 1.0;
        unbalanced_sum += found.unbalanced_ratio;
        unbalanced = worse_of(unbalanced, found.unbalanced_ratio);
        kinetic_share = worse_of(kinetic_share, found.kinetic_share);
        inertial_number = worse_of(inertial_number, found.inertial_number);
      });
    }
  }

  SCARP_MEMBERS(looked_at, unbalanced_sum, unbalanced, kinetic_share, inertial_number)
};

}  // namespace scarp

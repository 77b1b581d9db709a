// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>

#include "recorder.hpp"
#include "scarp/budget/budget_part.hpp"
#include "scarp/core/nan_max.hpp"

namespace rve_lab {

/// Error budget of a path, from the rows of its table.
struct RowBudget {
  scarp::ErrorBounds bounds{};
  double energy_gap_bound = 1e-3;  ///< three digits of the work
  int rows = 0;
  double unbalanced_sum = 0.0;
  double unbalanced = 0.0;
  double kinetic_share = 0.0;
  double energy_gap = 0.0;  ///< of the last row

  void add(Row const& row) {
    ++rows;
    unbalanced_sum += value(row, "unbalanced_ratio");
    unbalanced = scarp::nan_max(unbalanced, value(row, "unbalanced_ratio"));
    kinetic_share = scarp::nan_max(kinetic_share, std::abs(value(row, "kinetic_share")));
    double const turned_over = std::abs(value(row, "stored")) + value(row, "contact_loss") + value(row, "damping_loss");
    energy_gap = turned_over == 0.0 ? 0.0 : std::abs(value(row, "energy_gap")) / turned_over;
  }

  scarp::BudgetParts parts() const {
    return {{"unbalanced_mean", unbalanced_sum / rows, bounds.unbalanced_mean,
             "net force of a grain over contact force, mean of all rows"},
            {"unbalanced_largest", unbalanced, std::numeric_limits<double>::infinity(),
             "of one row, perhaps in the middle of a rearrangement"},
            {"kinetic_share", kinetic_share, bounds.kinetic_share, "of moving grains in the pressure, largest"},
            {"energy_gap", energy_gap, energy_gap_bound, "work that is neither stored nor lost, over what is"}};
  }
};

}  // namespace rve_lab

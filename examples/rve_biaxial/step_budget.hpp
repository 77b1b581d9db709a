// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "../shared/budget_report.hpp"
#include "biaxial_test.hpp"
#include "scarp/budget/budget_part.hpp"
#include "scarp/core/nan_max.hpp"

namespace rve_biaxial {

/// Over all packings. pressure [Pa]: that the servo holds
inline scarp::BudgetParts error_budget(std::vector<Result> const& results, double pressure,
                                       scarp::ErrorBounds const& bounds) {
  constexpr double none = std::numeric_limits<double>::infinity();
  double unbalanced_sum = 0.0;
  double unbalanced = 0.0;
  double inertial_number = 0.0;
  double missing_squares = 0.0;
  std::size_t rows = 0;
  std::vector<double> halved;
  for (auto const& result : results) {
    for (auto const& row : result.rows) {
      unbalanced = scarp::nan_max(unbalanced, row.unbalanced_ratio);
      unbalanced_sum += row.unbalanced_ratio;
      missing_squares += std::pow(row.lateral_stress / pressure - 1.0, 2);
    }
    rows += result.rows.size();
    inertial_number = scarp::nan_max(inertial_number, result.inertial_number);
    halved.insert(halved.end(), result.halved.begin(), result.halved.end());
  }
  scarp::BudgetParts parts{
      {"unbalanced_mean", unbalanced_sum / static_cast<double>(rows), bounds.unbalanced_mean,
       "net force of a grain over contact force, mean of all rows"},
      {"unbalanced_largest", unbalanced, none, "of one row, perhaps in the middle of a rearrangement"},
      {"inertial_number", inertial_number, bounds.inertial_number, "largest of a test"},
      {"held_stress", std::sqrt(missing_squares / static_cast<double>(rows)), bounds.held_stress,
       "lateral stress missing from the pressure, root mean square of all rows"}};
  if (!halved.empty()) {
    std::sort(halved.begin(), halved.end());
    parts.push_back({"doubling_median", halved[halved.size() / 2], bounds.doubling_median,
                     "change of a row's stress in steps of half the strain, relative"});
    parts.push_back({"doubling_largest", halved.back(), none, "of one sample"});
  }
  return parts;
}

}  // namespace rve_biaxial

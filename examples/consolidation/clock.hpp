// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "scarp/bvp/load_history.hpp"
#include "scarp/solver/load_stepping.hpp"

namespace consolidation {

/// Times of a run whose load factor counts its steps: the load comes at 1, without time, and then time passes in stages
/// whose steps grow by one factor.
class Clock {
 public:
  /// first [s]: end of the first step, in which a boundary that drains is felt no farther than an element can show
  explicit Clock(double first) : knots_{{0.0, 0.0}, {1.0, 0.0}, {2.0, first}} {}

  /// Up to a time [s], in so many steps.
  /// \return load factor of the time
  double add(double until, int steps) {
    auto const [load, start] = knots_.back();
    for (int k = 1; k <= steps; ++k)
      knots_.emplace_back(load + k, start * std::pow(until / start, static_cast<double>(k) / steps));
    return knots_.back().first;
  }
  scarp::TimeFunction time() const { return scarp::TimeFunction(knots_); }  ///< [s] over the load factor

 private:
  std::vector<std::pair<double, double>> knots_;
};

/// One step between two times of the clock.
inline constexpr scarp::LoadStepping by_the_clock{
    .first = 1.0, .smallest = 1e-6, .largest = 1.0, .max_displacement_gradient = 1.0};

}  // namespace consolidation

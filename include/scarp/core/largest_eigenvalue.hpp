// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "scarp/core/random.hpp"

namespace scarp {

namespace detail {

/// Largest eigenvalue of the symmetric tridiagonal matrix with these entries, none of them negative as a whole, by
/// bisection with Sturm's sequence.
inline double largest_of_tridiagonal(std::vector<double> const& diagonal, std::vector<double> const& beside) {
  double high = 0.0;  // Gershgorin
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    double const left = i > 0 ? beside[i - 1] : 0.0;
    double const right = i + 1 < diagonal.size() ? beside[i] : 0.0;
    high = std::max(high, diagonal[i] + std::abs(left) + std::abs(right));
  }
  auto const all_below = [&](double value) {
    double pivot = diagonal[0] - value;
    for (std::size_t i = 1; i < diagonal.size() && pivot < 0.0; ++i) {
      pivot = diagonal[i] - value - beside[i - 1] * beside[i - 1] / pivot;
    }
    return pivot < 0.0;
  };
  double low = 0.0;
  for (int halving = 0; halving < 60; ++halving) {
    double const middle = 0.5 * (low + high);
    (all_below(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace detail

/// Largest eigenvalue of a symmetric positive semidefinite matrix of a size, by Lanczos's method from a random start that is
/// always the same. apply(x, y): y = matrix times x. From below, relative error about `tolerance`; zero for a zero matrix.
/// \return NaN for entries that are no numbers, and where 300 products do not suffice
template <class Apply>
double largest_eigenvalue(std::size_t size, Apply&& apply, double tolerance) {
  constexpr int most_steps = 300;
  constexpr int look_every = 5;
  constexpr double invariant = 1e-10;  // what is left of a vector whose space has been used up
  std::vector<double> now(size), before(size, 0.0), next(size), diagonal, beside;
  Random random(1);
  double squared = 0.0;
  for (double& entry : now) {
    entry = random.uniform(-1.0, 1.0);
    squared += entry * entry;
  }
  for (double& entry : now) entry /= std::sqrt(squared);
  double coupling = 0.0;
  double known = 0.0;
  double scale = 0.0;
  for (int step = 1; step <= most_steps; ++step) {
    std::fill(next.begin(), next.end(), 0.0);
    apply(now, next);
    double along = 0.0;
    for (std::size_t i = 0; i < size; ++i) along += now[i] * next[i];
    double rest = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      next[i] -= along * now[i] + coupling * before[i];
      rest += next[i] * next[i];
    }
    coupling = std::sqrt(rest);
    if (!std::isfinite(coupling + along)) break;
    diagonal.push_back(along);
    scale = std::max(scale, along);
    bool const used_up = coupling <= invariant * scale;
    if (used_up || step % look_every == 0) {
      double const found = detail::largest_of_tridiagonal(diagonal, beside);
      if (used_up || found - known <= 0.1 * tolerance * found) return found;
      known = found;
    }
    beside.push_back(coupling);
    for (std::size_t i = 0; i < size; ++i) {
      before[i] = now[i];
      now[i] = next[i] / coupling;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace scarp

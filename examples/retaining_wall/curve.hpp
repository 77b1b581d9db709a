// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "rankine.hpp"

namespace retaining_wall {

/// Strain over which ratios of stress are averaged, of walls and of tests: single responses of small packings jump.
inline constexpr double window = 0.01;

/// Horizontal over vertical stress against strain, of a wall or of a test on a packing.
struct Curve {
  std::vector<double> strain{};  ///< increasing, from 0
  std::vector<double> ratio{};

  void add(double at, double value) {
    strain.push_back(at);
    ratio.push_back(value);
  }

  /// Over the window of strain that begins at `from` and lies inside the curve; linear between the rows.
  double mean(double from) const { return (integral(from + window) - integral(from)) / window; }

 private:
  double integral(double to) const {
    double sum = 0.0;
    for (std::size_t k = 1; k < strain.size() && strain[k - 1] < to; ++k) {
      double const part = std::min(1.0, (to - strain[k - 1]) / (strain[k] - strain[k - 1]));
      double const end = ratio[k - 1] + part * (ratio[k] - ratio[k - 1]);
      sum += part * (strain[k] - strain[k - 1]) * (ratio[k - 1] + end) / 2.0;
    }
    return sum;
  }
};

/// Least (active) or largest (passive) mean over a window of strain.
struct Extreme {
  double ratio = std::nan("");
  double strain = std::nan("");  ///< where the window begins
};

/// \return NaN for a curve that is shorter than the window
inline Extreme extreme(Curve const& curve, Movement movement) {
  Extreme found;
  for (double const from : curve.strain) {
    if (from + window > curve.strain.back() * (1.0 + 1e-9)) break;
    double const mean = curve.mean(from);
    if (sign_of(movement) * (mean - found.ratio) <= 0.0) continue;
    found = {mean, from};
  }
  return found;
}

}  // namespace retaining_wall

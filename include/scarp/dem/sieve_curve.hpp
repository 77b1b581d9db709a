// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/random.hpp"

namespace scarp {

/// Sizes of grains from a sieve analysis: the share of the mass that passes each diameter, straight lines between the sieves over the
/// logarithm of the diameter, as it is plotted.
struct SieveCurve {
  std::vector<double> diameters;  ///< [m], increasing
  std::vector<double> passing;    ///< share of the mass, from 0 to 1, one for each diameter

  /// \throws InputError for a curve that does not rise from 0 to 1 over increasing diameters
  void validate() const {
    if (diameters.size() < 2 || diameters.size() != passing.size())
      reject("a sieve curve has {} diameters and {} shares that pass (two or more of both are expected): complete it",
             diameters.size(), passing.size());
    for (std::size_t k = 0; k < diameters.size(); ++k) {
      require_positive("diameter of a sieve", diameters[k]);
      require_between("share that passes a sieve", passing[k], 0.0, 1.0);
      if (k > 0 && !(diameters[k] > diameters[k - 1] && passing[k] >= passing[k - 1]))
        reject("after a sieve of {} m, which {} passes, one of {} m is passed by {} (both increase): sort the sieves",
               diameters[k - 1], passing[k - 1], diameters[k], passing[k]);
    }
    if (passing.front() != 0.0 || passing.back() != 1.0)
      reject("a sieve curve runs from {} to {} (0 to 1 is expected): add the sieves that nothing and everything passes",
             passing.front(), passing.back());
  }

  /// Diameter [m] of a grain drawn by number. Between two sieves the mass is uniform over ln d, hence the number
  /// goes with \f$ d^{-1-n} \f$ in n dimensions.
  /// dim: 2 where grains are prisms, whose mass goes with the square of their diameter, else 3
  double sample(Random& random, int dim) const {
    auto const inverse = [&](double diameter) { return std::pow(diameter, -dim); };
    std::vector<double> counts;  // grains up to each sieve, in proportion
    double sum = 0.0;
    for (std::size_t k = 1; k < diameters.size(); ++k) {
      double const share = (passing[k] - passing[k - 1]) / std::log(diameters[k] / diameters[k - 1]);
      counts.push_back(sum += share * (inverse(diameters[k - 1]) - inverse(diameters[k])));
    }
    auto const found = std::ranges::upper_bound(counts, random.uniform(0.0, sum));
    auto const k = std::min(static_cast<std::size_t>(found - counts.begin()), counts.size() - 1);
    return std::pow(random.uniform(inverse(diameters[k + 1]), inverse(diameters[k])), -1.0 / dim);
  }
};

}  // namespace scarp

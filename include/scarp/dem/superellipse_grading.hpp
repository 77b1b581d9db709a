// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/random.hpp"
#include "scarp/shape/superellipse.hpp"

namespace scarp {

/// Major half axes uniform between two bounds [m]; minor = aspect x major; one exponent for all.
struct SuperellipseGrading {
  using Shape = Superellipse;

  double smallest = 0.0;
  double largest = 0.0;
  double aspect = 1.0;
  double exponent = 1.0;

  Superellipse::Size<double> sample(Random& random) const {
    double const major = random.uniform(smallest, largest);
    return {major, aspect * major, exponent};
  }
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/random.hpp"
#include "scarp/shape/ellipse.hpp"

namespace scarp {

/// Semi-major axes uniform between two bounds [m]; semi-minor = aspect x semi-major.
struct EllipseGrading {
  using Shape = Ellipse;

  double smallest = 0.0;
  double largest = 0.0;
  double aspect = 1.0;

  Ellipse::Size<double> sample(Random& random) const {
    double const major = random.uniform(smallest, largest);
    return {major, aspect * major};
  }
};

}  // namespace scarp

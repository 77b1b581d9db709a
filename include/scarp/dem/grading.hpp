// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/error.hpp"
#include "scarp/core/random.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"

namespace scarp {

/// Radii uniform between two bounds [m].
struct DiscGrading {
  using Shape = Disc;

  double smallest = 0.0;
  double largest = 0.0;

  Disc::Size<double> sample(Random& random) const { return {random.uniform(smallest, largest)}; }
};

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

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/random.hpp"
#include "scarp/shape/sphere.hpp"

namespace scarp {

/// Radii uniform between two bounds [m].
struct SphereGrading {
  using Shape = Sphere;

  double smallest = 0.0;
  double largest = 0.0;

  Sphere::Size<double> sample(Random& random) const { return {random.uniform(smallest, largest)}; }
};

}  // namespace scarp

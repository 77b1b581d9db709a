// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/random.hpp"
#include "scarp/shape/particle_shape.hpp"

namespace scarp {

/// Radii of round grains, uniform between two bounds [m].
template <class ShapePolicy>
struct RadiusGrading {
  using Shape = ShapePolicy;

  double smallest = 0.0;
  double largest = 0.0;

  SizeOf<Shape> sample(Random& random) const { return {random.uniform(smallest, largest)}; }
};

}  // namespace scarp

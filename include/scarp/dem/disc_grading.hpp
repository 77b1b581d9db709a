// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/random.hpp"
#include "scarp/shape/disc.hpp"

namespace scarp {

/// Radii uniform between two bounds [m].
struct DiscGrading {
  using Shape = Disc;

  double smallest = 0.0;
  double largest = 0.0;

  Disc::Size<double> sample(Random& random) const { return {random.uniform(smallest, largest)}; }
};

}  // namespace scarp

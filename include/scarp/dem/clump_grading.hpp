// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/random.hpp"
#include "scarp/shape/clump.hpp"

namespace scarp {

/// Scales of a clump uniform between two bounds [m].
template <class Template>
struct ClumpGrading {
  using Shape = Clump<Template>;

  double smallest = 0.0;
  double largest = 0.0;

  SizeOf<Shape> sample(Random& random) const { return {random.uniform(smallest, largest)}; }
};

}  // namespace scarp

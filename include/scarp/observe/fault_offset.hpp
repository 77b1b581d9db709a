// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <limits>

namespace scarp {

/// A dip-slip fault below the ground, its foot wall on the left, and how far its walls have settled. With the share of
/// the offset in place of settlement normal and reverse faults, and those that move both walls, are alike.
struct FaultOffset {
  double tip = 0.0;      ///< where the fault meets the bottom of the ground, along the first axis [m]
  double foot = 0.0;     ///< settlement of the foot wall, positive down [m]
  double hanging = 0.0;  ///< settlement of the hanging wall, negative where it rises [m]

  /// (settlement - foot) / (hanging - foot): 0 with the foot wall, 1 with the hanging wall; NaN without an offset
  double share(double settlement) const {
    return hanging == foot ? std::numeric_limits<double>::quiet_NaN() : (settlement - foot) / (hanging - foot);
  }
};

}  // namespace scarp

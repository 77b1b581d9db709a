// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/observe/fault_offset.hpp"
#include "scarp/observe/surface_profile.hpp"

namespace scarp {

/// Where a fault comes out at the surface, by the steepest part of the profile between two joined points: the whole
/// offset runs along that one line. `rupture_measures` gives places that do not hang on a single facet.
struct Outcrop {
  double outcrop_x;   ///< where the steepest part's line meets the surface of the foot wall [m]
  double steepest_x;  ///< middle of the steepest part [m]
  double width;       ///< distance over which that line runs through the full offset [m]
};

/// In places at rest. NaN where nothing goes the hanging wall's way, and for walls without an offset.
inline Outcrop outcrop(std::vector<SurfacePoint> const& profile, FaultOffset const& fault) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Outcrop found{none, none, none};
  double steepest = 0.0;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    auto const& a = profile[k - 1];
    auto const& b = profile[k];
    double const apart = b.x_initial - a.x_initial;
    if (!b.joined || !(apart > 0.0)) continue;
    double const from = fault.share(a.settlement);
    double const to = fault.share(b.settlement);
    double const slope = (to - from) / apart;
    if (!(slope > steepest)) continue;
    steepest = slope;
    double const middle = (a.x_initial + b.x_initial) / 2.0;
    found = {middle - (from + to) / 2.0 / slope, middle, 1.0 / slope};
  }
  return found;
}

/// Of a fault whose foot wall stays and whose hanging wall goes down by fault_throw [m], up where that is negative.
inline Outcrop outcrop(std::vector<SurfacePoint> const& profile, double fault_throw) {
  return outcrop(profile, FaultOffset{.hanging = fault_throw});
}

}  // namespace scarp

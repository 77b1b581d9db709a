// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>

#include "scarp/fault/surface_profile.hpp"

namespace scarp {

/// A dip-slip fault below the ground, its footwall on the left, and how far its walls have settled. With the share of
/// the offset in place of settlement normal and reverse faults, and those that move both walls, are alike.
struct FaultOffset {
  double tip = 0.0;      ///< where the fault meets the bottom of the ground, along the first axis [m]
  double foot = 0.0;     ///< settlement of the footwall, positive down [m]
  double hanging = 0.0;  ///< settlement of the hanging wall, negative where it rises [m]

  /// (settlement - foot) / (hanging - foot): 0 with the footwall, 1 with the hanging wall; NaN without an offset
  double share(double settlement) const {
    return hanging == foot ? std::numeric_limits<double>::quiet_NaN() : (settlement - foot) / (hanging - foot);
  }
};

/// Where a fault comes out at the surface, by the steepest part of the profile between two joined points: the whole
/// offset runs along that one line. `rupture_measures` gives places that do not depend on a single facet.
struct Outcrop {
  double outcrop_x;   ///< where the steepest part's line meets the surface of the footwall [m]
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

/// First place, coming from the footwall's side, where a profile passes a share of the fault's offset, linear between
/// points [m] at rest. NaN where it passes in a gap, has passed before the profile begins, or does not pass.
inline double first_passage(std::vector<SurfacePoint> const& profile, FaultOffset const& fault, double share) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < profile.size(); ++k) {
    double const to = fault.share(profile[k].settlement);
    if (!(to >= share)) continue;
    if (k == 0 || !profile[k].joined) return none;
    double const from = fault.share(profile[k - 1].settlement);
    double const part = (share - from) / (to - from);
    return profile[k - 1].x_initial + part * (profile[k].x_initial - profile[k - 1].x_initial);
  }
  return none;
}

/// Inclination of a line through the ground that goes to the left by `left` while it rises by `up`, from 0 up to pi
/// [rad]; above pi/2 it leans to the right, over the hanging wall. NaN for NaN.
inline double line_dip(double left, double up) { return std::atan2(up, left); }

/// Where and how sharply the offset of a fault comes out at the ground surface. Places are those at rest [m]; NaN where
/// there is none.
struct RuptureMeasures {
  double
      surface_x05;  ///< first place, from the footwall's side, that has gone 5 % of the offset: where the scarp begins
  double surface_x50;        ///< half of the offset: the middle of the rupture
  double surface_x95;        ///< 95 % of it: where the scarp ends, further off where a graben lies behind it
  double surface_slope_max;  ///< largest |change of settlement / distance| between joined points
  double rupture_dip;        ///< of the line from the fault's tip to surface_x50, see line_dip [rad]
  double largest_share;      ///< of the offset that any point has gone: above 1 in a graben
  double outcrop_x;          ///< see Outcrop, as the next two
  double steepest_x;         ///< middle of the steepest part [m]
  double outcrop_width;      ///< [m]
};

/// depth: height of the surface above the tip [m]
inline RuptureMeasures rupture_measures(std::vector<SurfacePoint> const& profile, FaultOffset const& fault,
                                        double depth) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double slope = none;
  double share = none;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    share = std::fmax(share, fault.share(profile[k].settlement));
    if (k == 0 || !profile[k].joined) continue;
    double const apart = profile[k].x_initial - profile[k - 1].x_initial;
    slope = std::fmax(slope, std::abs(profile[k].settlement - profile[k - 1].settlement) / apart);
  }
  auto const [outcrop_x, steepest_x, width] = outcrop(profile, fault);
  double const middle = first_passage(profile, fault, 0.5);
  return {.surface_x05 = first_passage(profile, fault, 0.05),
          .surface_x50 = middle,
          .surface_x95 = first_passage(profile, fault, 0.95),
          .surface_slope_max = slope,
          .rupture_dip = line_dip(fault.tip - middle, depth),
          .largest_share = share,
          .outcrop_x = outcrop_x,
          .steepest_x = steepest_x,
          .outcrop_width = width};
}

}  // namespace scarp

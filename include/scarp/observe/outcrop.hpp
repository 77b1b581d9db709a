// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scarp/core/tensor.hpp"

namespace scarp {

/// A point of the ground surface: where it was, where it is, how far it has settled. [m]
struct SurfacePoint {
  double x_initial;
  double x;
  double settlement;  ///< positive down
};

/// Ground surface profile, from left to right. positions [m] are the present ones of the mesh's nodes.
template <class MeshType>
std::vector<SurfacePoint> surface_profile(MeshType const& mesh, std::vector<Vector<2>> const& positions,
                                          std::vector<int> const& nodes) {
  std::vector<SurfacePoint> profile;
  for (int const node : nodes) {
    auto const n = static_cast<std::size_t>(node);
    profile.push_back({mesh.nodes[n](0), positions[n](0), mesh.nodes[n](1) - positions[n](1)});
  }
  std::sort(profile.begin(), profile.end(), [](auto const& a, auto const& b) { return a.x_initial < b.x_initial; });
  return profile;
}

/// Where a fault comes out at the surface, by the steepest part of the profile between two neighbouring points.
struct Outcrop {
  double outcrop_x;   ///< where the steepest part's line meets the undeformed surface [m]
  double steepest_x;  ///< middle of the steepest part [m]
  double width;       ///< distance over which that line falls by the full throw [m]
};

/// In initial positions. NaN where nothing has settled.
inline Outcrop outcrop(std::vector<SurfacePoint> const& profile, double fault_throw) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Outcrop found{none, none, none};
  double steepest = 0.0;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    auto const& a = profile[k - 1];
    auto const& b = profile[k];
    double const slope = (b.settlement - a.settlement) / (b.x_initial - a.x_initial);
    if (!(slope > steepest)) continue;
    steepest = slope;
    double const middle = (a.x_initial + b.x_initial) / 2.0;
    found = {middle - (a.settlement + b.settlement) / 2.0 / slope, middle, fault_throw / slope};
  }
  return found;
}

/// Settlement at a place, linear between the points; that of the nearest end outside.
inline double settlement_at(std::vector<SurfacePoint> const& profile, double x_initial) {
  if (x_initial <= profile.front().x_initial) return profile.front().settlement;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    auto const& a = profile[k - 1];
    auto const& b = profile[k];
    if (x_initial > b.x_initial) continue;
    double const share = (x_initial - a.x_initial) / (b.x_initial - a.x_initial);
    return a.settlement + share * (b.settlement - a.settlement);
  }
  return profile.back().settlement;
}

}  // namespace scarp

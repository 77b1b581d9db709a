// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <limits>
#include <vector>

namespace scarp {

/// A place of the ground surface, or of a level inside the ground: where it was, where it is, how far it has settled.
/// [m]
struct SurfacePoint {
  double x_initial;    ///< when the fault began to move
  double x;            ///< now
  double settlement;   ///< since then, positive down
  bool joined = true;  ///< to the point before it, by ground without a gap; of the first point it says nothing
};

/// Settlement at a place of a profile, linear between joined points; that of the nearest end outside. NaN inside a gap,
/// where nothing is known, and for an empty profile.
inline double settlement_at(std::vector<SurfacePoint> const& profile, double x_initial) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (profile.empty()) return none;
  if (x_initial <= profile.front().x_initial) return profile.front().settlement;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    auto const& a = profile[k - 1];
    auto const& b = profile[k];
    if (x_initial > b.x_initial) continue;
    if (x_initial == b.x_initial) return b.settlement;
    if (!b.joined) return none;
    double const share = (x_initial - a.x_initial) / (b.x_initial - a.x_initial);
    return a.settlement + share * (b.settlement - a.settlement);
  }
  return profile.back().settlement;
}

}  // namespace scarp

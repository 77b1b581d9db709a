// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scarp/core/error.hpp"
#include "scarp/fault/bedrock_motion.hpp"

namespace scarp::detail {

/// Horizontal slip per throw on a plane that dips by so much [rad], 1/tan(dip); exactly zero for a vertical one.
/// \throws InputError for a dip outside (0, pi/2]
inline double heave_per_throw(double dip) {
  constexpr double vertical = std::numbers::pi / 2.0;
  if (!(dip > 0.0 && dip <= vertical * (1.0 + 4.0 * std::numeric_limits<double>::epsilon()))) {
    refuse("the dip is {} rad (a fault dips by more than 0 and at most pi/2): {}", dip,
           dip > vertical && dip <= 90.0 ? "was it given in degrees?" : "choose a dip in this range");
  }
  double const along = std::cos(dip);
  return std::abs(along) < std::numeric_limits<double>::epsilon() ? 0.0 : along / std::sin(dip);
}

}  // namespace scarp::detail

namespace scarp {

/// The hanging wall, right of the tip, slides down the fault plane and away from the footwall, which stays.
struct NormalFault {
  double dip = std::numbers::pi / 3.0;  ///< angle of the fault plane against the horizontal [rad], up to pi/2
  double tip = 0.0;                     ///< where the fault meets the bottom of the ground [m]

  Vector<2> left() const { return Vector<2>::Zero(); }
  /// \throws InputError for a dip outside (0, pi/2]
  Vector<2> right() const { return {detail::heave_per_throw(dip), -1.0}; }
};

static_assert(BedrockMotion<NormalFault>);

/// The hanging wall, right of the tip, is pushed up the fault plane and over the footwall, which stays.
struct ReverseFault {
  double dip = std::numbers::pi / 3.0;  ///< angle of the fault plane against the horizontal [rad], up to pi/2
  double tip = 0.0;                     ///< where the fault meets the bottom of the ground [m]

  Vector<2> left() const { return Vector<2>::Zero(); }
  /// \throws InputError for a dip outside (0, pi/2]
  Vector<2> right() const { return {-detail::heave_per_throw(dip), 1.0}; }
};

static_assert(BedrockMotion<ReverseFault>);

/// A fault that dies out along its strike: all of its slip up to `full_to`, none from `ends_at` on, and half a cosine
/// in between, level at both ends, so that planes of symmetry fit there. In the plane it is the fault itself.
/// \code
/// TaperedSlip<NormalFault>{{.dip = 1.0}, 0.0, 50.0}
/// \endcode
template <BedrockMotion Fault>
struct TaperedSlip : Fault {
  double full_to = 0.0;   ///< [m] along the strike
  double ends_at = 50.0;  ///< [m] along the strike, beyond `full_to`

  /// Share of the slip at y [m], from 1 to 0.
  /// \throws InputError for ends that are not finite or in the wrong order
  double share_along(double y) const {
    if (!(std::isfinite(full_to) && std::isfinite(ends_at) && full_to < ends_at)) {
      refuse("the slip is full up to y = {} m and ends at {} m (it dies out along the strike): put the end beyond",
             full_to, ends_at);
    }
    double const beyond = std::clamp((y - full_to) / (ends_at - full_to), 0.0, 1.0);
    return (1.0 + std::cos(std::numbers::pi * beyond)) / 2.0;
  }
};

}  // namespace scarp

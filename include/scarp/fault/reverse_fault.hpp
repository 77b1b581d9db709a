// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/fault/bedrock_motion.hpp"
#include "scarp/fault/detail/fault_plane.hpp"

namespace scarp {

/// The hanging wall, right of the tip, is pushed up the fault plane and over the foot wall, which stays.
struct ReverseFault {
  double dip = std::numbers::pi / 3.0;  ///< angle of the fault plane against the horizontal [rad], up to pi/2
  double tip = 0.0;                     ///< where the fault meets the bottom of the ground [m]

  Vector<2> left() const { return Vector<2>::Zero(); }
  /// \throws InputError for a dip outside (0, pi/2]
  Vector<2> right() const { return {-detail::heave_per_throw(dip), 1.0}; }
};

static_assert(BedrockMotion<ReverseFault>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scarp/fault/bedrock_motion.hpp"

namespace scarp {

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

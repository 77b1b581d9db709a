// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/strength.hpp"

namespace scarp {

/// Strength that falls from peak to residual, linear in the plastic shear strain (angles in radians, cohesion and tension in
/// pascals each for itself). Where one of the two cuts no tension off, the other's cut-off holds in between. Without an
/// internal length the dissipation of a band depends on the mesh.
struct SofteningStrength {
  static constexpr bool changes = true;

  Strength peak{};
  Strength residual{};
  double strain_to_residual = 0.1;  ///< plastic shear strain at which the residual strength is reached

  Strength at(double plastic_shear) const {
    double const done = std::clamp(plastic_shear / strain_to_residual, 0.0, 1.0);
    auto const between = [&](double from, double to) {
      if (from == to || done == 0.0 || std::isinf(to)) return done < 1.0 ? from : to;
      return done == 1.0 || std::isinf(from) ? to : from + done * (to - from);
    };
    return {between(peak.cohesion, residual.cohesion), between(peak.friction, residual.friction),
            between(peak.dilation, residual.dilation), between(peak.cut_off(), residual.cut_off())};
  }
};

/// \throws InputError for a peak or residual strength that cannot be, or a fall over no strain
inline void require_sound(SofteningStrength const& strength) {
  require_positive("plastic shear strain from peak to residual strength", strength.strain_to_residual);
  require_sound(strength.peak);
  require_sound(strength.residual);
}

static_assert(StrengthLaw<SofteningStrength>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/strength.hpp"

namespace scarp {

/// Strength that falls from peak to residual, linear in the plastic shear strain (angles in radians, cohesion and tension in
/// pascals each for itself). Without an internal length the dissipation of a band depends on the mesh.
struct SofteningStrength {
  static constexpr bool changes = true;

  Strength peak{};
  Strength residual{};
  double strain_to_residual = 0.1;  ///< plastic shear strain at which the residual strength is reached

  Strength at(double plastic_shear) const {
    double const done = std::clamp(plastic_shear / strain_to_residual, 0.0, 1.0);
    auto const between = [&](double from, double to) { return from == to ? from : from + done * (to - from); };
    return {between(peak.cohesion, residual.cohesion), between(peak.friction, residual.friction),
            between(peak.dilation, residual.dilation), between(peak.cut_off(), residual.cut_off())};
  }
};

static_assert(StrengthLaw<SofteningStrength>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

#include "scarp/core/error.hpp"

namespace scarp {

/// Mohr-Coulomb strength of a material: what its stress may not exceed and how it flows there.
struct Strength {
  double cohesion = 0.0;                                     ///< [Pa]
  double friction = 0.0;                                     ///< phi [rad], from 0 to below pi/2
  double dilation = 0.0;                                     ///< psi [rad], from 0 to phi
  double tension = std::numeric_limits<double>::infinity();  ///< largest tensile principal stress [Pa]

  /// Hydrostatic tension at which the surface closes, \f$ c \cot\varphi \f$ [Pa]; infinite without friction.
  double apex() const {
    return friction > 0.0 ? cohesion / std::tan(friction) : std::numeric_limits<double>::infinity();
  }

  /// The tensile stress that is cut off; beyond the apex there is nothing to cut.
  double cut_off() const { return std::min(tension, apex()); }

  /// \throws InputError for angles out of order (were they given in degrees?), negative or not finite strengths
  void validate() const {
    require_not_negative("cohesion", cohesion);
    if (!(friction >= 0.0 && friction < 0.999 * std::numbers::pi / 2.0)) {
      reject("the friction angle is {} rad (it must be from 0 to below a right angle): {}", friction,
             friction > 1.5 && friction < 90.0 ? "was it given in degrees?" : "give radians");
    }
    if (!(dilation >= 0.0 && dilation <= friction)) {
      reject(
          "the angle of dilation is {} rad with a friction of {} rad (beyond it flow would create energy): choose one "
          "from 0 to the friction",
          dilation, friction);
    }
    if (!(tension >= 0.0)) {
      reject("the tensile strength is {} Pa (it must not be negative): give zero for none, infinity for no cut-off",
             tension);
    }
  }
};

/// at(plastic shear strain): the strength after so much plastic shear, the accumulated difference of the largest and
/// the smallest principal plastic strain. `changes`: whether it depends on it at all.
template <class Law>
concept StrengthLaw = std::copyable<Law> && requires(Law const& law, double plastic_shear) {
  { law.at(plastic_shear) } -> std::same_as<Strength>;
  { Law::changes } -> std::convertible_to<bool>;
};

/// Strength that plastic strain does not change.
struct ConstantStrength {
  static constexpr bool changes = false;  ///< whether plastic strain changes the strength

  Strength strength{};  ///< at every plastic strain

  /// The constant strength, for any plastic shear strain.
  Strength at(double) const { return strength; }
  void validate() const { strength.validate(); }
};

static_assert(StrengthLaw<ConstantStrength>);

/// Strength that falls from peak to residual, linear in the plastic shear strain (angles in radians, cohesion and
/// tension in pascals each for itself). Where one of the two cuts no tension off, the other's cut-off holds in between.
/// Without an internal length the dissipation of a band depends on the mesh.
struct SofteningStrength {
  static constexpr bool changes = true;  ///< whether plastic strain changes the strength

  Strength peak{};                ///< at zero plastic shear strain
  Strength residual{};            ///< from `softening_strain` on
  double softening_strain = 0.1;  ///< plastic shear strain at which the residual strength is reached

  /// Strength at an accumulated plastic shear strain.
  Strength at(double plastic_shear) const {
    double const done = std::clamp(plastic_shear / softening_strain, 0.0, 1.0);
    auto const between = [&](double from, double to) {
      if (from == to || done == 0.0 || std::isinf(to)) return done < 1.0 ? from : to;
      return done == 1.0 || std::isinf(from) ? to : from + done * (to - from);
    };
    return {between(peak.cohesion, residual.cohesion), between(peak.friction, residual.friction),
            between(peak.dilation, residual.dilation), between(peak.cut_off(), residual.cut_off())};
  }

  /// \throws InputError for a peak or residual strength that cannot be, or a fall over no strain
  void validate() const {
    require_positive("plastic shear strain from peak to residual strength", softening_strain);
    peak.validate();
    residual.validate();
  }
};

static_assert(StrengthLaw<SofteningStrength>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <concepts>

#include "scarp/constitutive/buoyancy.hpp"
#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/error.hpp"

namespace scarp {

/// at(depth): the stress [Pa], tension positive, that a point at `depth` [m] below the ground surface starts with.
template <class Field, int Dim>
concept InitialStressField = requires(Field const& field, double depth) {
  { field.at(depth) } -> std::same_as<VoigtStress<Dim>>;
};

/// Level ground at rest: vertical \f$ \sigma_v = -(q + \gamma z) \f$ less what water carries, horizontal
/// \f$ \sigma_h = K_0 \sigma_v \f$, no shear. The vertical is the last axis; compression is negative.
template <int Dim>
struct GeostaticStress {
  double surcharge = 0.0;    ///< q [Pa], vertical pressure on the ground surface, positive in compression
  double unit_weight = 0.0;  ///< gamma [N/m3]
  double k0 = 1.0;           ///< horizontal over vertical stress
  Buoyancy buoyancy{};       ///< of the water table in it; stresses are effective ones

  /// \throws InputError for a number that is negative or not finite, and ground that floats
  void validate() const {
    require_not_negative("surcharge on the ground surface", surcharge);
    require_not_negative("unit weight", unit_weight);
    require_not_negative("ratio of horizontal to vertical stress, K0,", k0);
    buoyancy.validate(unit_weight);
  }

  /// depth [m]
  /// \throws InputError above the ground surface
  VoigtStress<Dim> at(double depth) const {
    require_below_surface(depth);
    double const vertical = -(surcharge + unit_weight * std::max(depth, 0.0) - buoyancy.relief(depth));
    VoigtStress<Dim> stress = VoigtStress<Dim>::Zero();
    stress.template head<Dim - 1>().setConstant(k0 * vertical);
    stress(Dim - 1) = vertical;
    return stress;
  }
};

/// Initial stress zero at every depth.
template <int Dim>
struct StressFree {
  /// Zero [Pa] at every depth [m].
  VoigtStress<Dim> at(double) const { return VoigtStress<Dim>::Zero(); }
};

/// The stress [Pa] that a point starts with.
/// \throws InputError for a field whose numbers are wrong and for a stress that is not finite
template <int Dim, class Field>
  requires InitialStressField<Field, Dim> VoigtStress<Dim> initial_stress(Field const& field, Site<Dim> const& site) {
    VoigtStress<Dim> const stress = detail::validated(field).at(site.depth);
    if (!stress.allFinite())
      reject("the initial stress of point {} is not finite (its depth is {} m): correct the field or the point's depth",
             site.index, site.depth);
    return stress;
  }

static_assert(InitialStressField<GeostaticStress<2>, 2> && InitialStressField<GeostaticStress<3>, 3>);
static_assert(InitialStressField<StressFree<2>, 2> && InitialStressField<StressFree<3>, 3>);

}  // namespace scarp

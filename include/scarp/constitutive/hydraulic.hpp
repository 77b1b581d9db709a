// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

#include "scarp/core/error.hpp"

namespace scarp {

/// How water moves through the pores of a ground and how much of it they store, by the void ratio (volume of pores over
/// that of grains). mobility(void_ratio): permeability over viscosity k/mu [m2/(Pa s)]; storage(void_ratio): volume of
/// water that a volume of ground takes in per pressure, without a change of its pores [1/Pa].
template <class Flow>
concept HydraulicProvider = requires(Flow const& flow, double void_ratio) {
  { flow.mobility(void_ratio) } -> std::convertible_to<double>;
  { flow.storage(void_ratio) } -> std::convertible_to<double>;
  {flow.validate()};
};

/// Water in the pores. Grains count as incompressible.
struct Water {
  double bulk_modulus = 2.2e9;  ///< K_w [Pa], less where there is air in it; infinite where its volume does not change
  double unit_weight = 9.81e3;  ///< [N/m3]
  double viscosity = 1e-3;      ///< [Pa s], at 20 degrees

  /// \throws InputError for a number that is not positive, and an infinite one but for the bulk modulus
  void validate() const {
    if (bulk_modulus != std::numeric_limits<double>::infinity())
      require_positive("bulk modulus of the pore water", bulk_modulus);
    require_positive("unit weight of the pore water", unit_weight);
    require_positive("viscosity of the pore water", viscosity);
  }
  /// By which it carries the grains of ground [N/m3], \f$ \gamma_w/(1+e) \f$: the buoyant unit weight of ground is its
  /// dry one less this.
  double lift(double void_ratio) const { return unit_weight / (1.0 + void_ratio); }
  /// \f$ n/K_w,\; n = e/(1+e) \f$ [1/Pa]
  double storage(double void_ratio) const { return void_ratio / (1.0 + void_ratio) / bulk_modulus; }
};

/// One hydraulic conductivity, whatever becomes of the pores: Darcy's law \f$ q = -k_h \nabla u/\gamma_w \f$.
struct ConstantPermeability {
  double conductivity = 0.0;  ///< k_h [m/s]; 0: impermeable
  Water water{};              ///< in the pores

  /// \throws InputError for a negative conductivity and wrong numbers of the water
  void validate() const {
    require_not_negative("hydraulic conductivity", conductivity);
    water.validate();
  }
  /// Permeability over viscosity [m2/(Pa s)].
  double mobility(double) const { return conductivity / water.unit_weight; }
  /// That of the water alone [1/Pa].
  double storage(double void_ratio) const { return water.storage(void_ratio); }
};

/// Permeability of a packing of grains by its own void ratio e,
/// \f$ k = \frac{d^2}{180}\frac{n^3}{(1-n)^2} = \frac{d^2}{180}\frac{e^3}{1+e} \f$ [m2] (Kozeny 1927; Carman 1937).
struct KozenyCarman {
  double grain = 0.0;     ///< d [m], diameter of equal spheres with the surface of the grains
  double factor = 180.0;  ///< of spheres
  Water water{};          ///< in the pores

  /// Grains that pass so much water [m/s] at a void ratio.
  /// \throws InputError for numbers that are not positive, also of the water
  static KozenyCarman of_conductivity(double conductivity, double void_ratio, Water const& water = {}) {
    water.validate();
    require_positive("hydraulic conductivity", conductivity);
    require_positive("void ratio of the ground with pore water", void_ratio);
    KozenyCarman flow{.grain = 1.0, .water = water};
    flow.grain = std::sqrt(conductivity / water.unit_weight / flow.mobility(void_ratio));
    return flow;
  }

  /// \throws InputError for a diameter or factor that is not positive and wrong numbers of the water
  void validate() const {
    require_positive("grain diameter of a permeability", grain);
    require_positive("factor of a permeability", factor);
    water.validate();
  }
  /// Permeability over viscosity [m2/(Pa s)].
  double mobility(double void_ratio) const {
    double const e = void_ratio;
    return grain * grain * e * e * e / (factor * (1.0 + e) * water.viscosity);
  }
  /// That of the water alone [1/Pa].
  double storage(double void_ratio) const { return water.storage(void_ratio); }
};

static_assert(HydraulicProvider<ConstantPermeability>);
static_assert(HydraulicProvider<KozenyCarman>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "scarp/bvp/pore_water.hpp"
#include "scarp/fault/fault_scene.hpp"

namespace scarp {

/// Times of a rupture of saturated ground.
struct RuptureTimes {
  double rupture = 1.0;   ///< that the whole throw takes [s]
  double drainage = 0.0;  ///< after the throw, while the bedrock rests [s]

  static constexpr double per_decade = 6.0;  ///< steps of drainage, from a tenth of the rupture's time on

  /// \throws InputError for a rupture that takes no time, and a negative time of drainage
  void validate() const {
    require_positive("time of the rupture", rupture);
    require_not_negative("time of drainage", drainage);
  }

  /// Load factor at the end of the drainage, in which it grows by a thousandth of the throw [m].
  double end(double throw_to) const { return drainage > 0.0 ? 1.001 * throw_to : throw_to; }
  /// Time [s] over the load factor, the throw [m]. start: load factor of the ground at rest; before: time [s] that it
  /// has to drain there, and again while a structure is placed
  TimeFunction clock(double start, double throw_to, double before) const {
    std::vector<std::pair<double, double>> knots{{start, before}};
    if (start < 0.0) knots.emplace_back(0.0, 2.0 * before);
    double const ruptured = knots.back().second + rupture;
    knots.emplace_back(throw_to, ruptured);
    double const first = std::min(rupture / 10.0, drainage);
    double const steps = drainage > 0.0 ? std::floor(per_decade * std::log10(drainage / first)) + 1.0 : 0.0;
    for (double step = 1.0; step <= steps; step += 1.0) {
      double const passed = drainage * std::pow(first / drainage, steps > 1.0 ? (steps - step) / (steps - 1.0) : 0.0);
      knots.emplace_back(throw_to + step / steps * (end(throw_to) - throw_to), ruptured + passed);
    }
    return TimeFunction(std::move(knots));
  }
};

/// Ground whose pores are full of water below a water table, and what stands on it. The scene's unit weight is that of
/// dry ground; its soil needs the buoyancy(), with which its stresses are effective ones. The surface drains, below a
/// structure too. Before the fault moves, and while a structure is placed, all excess pressures drain.
/// \tparam Structure a `StandsOnGround`
template <class Structure, HydraulicProvider Flow = KozenyCarman>
struct Saturated : Structure {
  Flow flow{};                                 ///< of the soil
  double shear_modulus = 0.0;                  ///< of the ground in size [Pa], see PoreWaterSettings
  double void_ratio = 0.7;                     ///< at the start
  double water_table = 0.0;                    ///< depth below the surface [m], negative for water that stands on it
  RuptureTimes times{};                        ///< of throw and drainage
  std::optional<double> largest_time_error{};  ///< of the pressures in one step [Pa], see PoreWaterSettings

  /// Of the ground at the start. \throws InputError for a void ratio that is not positive
  Buoyancy buoyancy() const {
    return {water_table, pore_water().lift(require_positive("void ratio of saturated ground", void_ratio))};
  }

  /// throw_to [m]
  /// \throws InputError for properties outside of their range
  template <class Grid>
  PoreWater<Grid, Flow> field(Grid const& grid, double throw_to) const {
    double const surface = surface_level(grid.mesh());
    double const depth = surface - bottom_level(grid.mesh());
    double const diffusion = 2.0 * shear_modulus * detail::validated(flow).mobility(void_ratio);  // [m2/s]
    constexpr double drained =
        1e6;  // times that diffusion through the depth takes: a millionth of the pressure is left
    double const before = drained * depth * depth / require_positive("shear modulus and conductivity", diffusion);
    PoreWater<Grid, Flow> water(
        grid, flow,
        {.shear_modulus = shear_modulus,
         .void_ratio = void_ratio,
         .clock = detail::validated(times).clock(this->start(), throw_to, before),
         .at_rest = WaterAtRest{.level = surface - water_table, .unit_weight = pore_water().unit_weight},
         .largest_time_error = largest_time_error});
    for (auto const& region : grid.regions())
      if (region != "soil") water.exclude(region);
    for (auto const* above : {"surface", "footing_base"})
      if (grid.has_boundary(above)) water.drain({above});
    return water;
  }
  /// That of the flow where it has one.
  Water pore_water() const {
    if constexpr (requires { flow.water; }) return flow.water;
    return {};
  }
  /// Load factor at the end, when the water has drained. throw_to [m]
  double end(double throw_to) const { return times.end(throw_to); }
};

}  // namespace scarp

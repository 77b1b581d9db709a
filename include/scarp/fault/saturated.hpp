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

  static constexpr double per_decade = 6.0;  ///< steps of drainage, from a hundredth of the rupture's time on

  /// \throws InputError for a rupture that takes no time, and a negative time of drainage
  void validate() const {
    require_positive("time of the rupture", rupture);
    require_not_negative("time of drainage", drainage);
  }

  /// Load factor at the end of the drainage, in which it grows by a ten-thousandth of the throw [m].
  double end(double throw_to) const { return drainage > 0.0 ? 1.0001 * throw_to : throw_to; }
  /// Time [s] since the fault began to move, over the load factor, the throw [m]. start: load factor of the ground at
  /// rest, below 0 where a structure is placed; before: time [s] that the water has to drain then
  TimeFunction clock(double start, double throw_to, double before) const {
    std::vector<std::pair<double, double>> knots{{0.0, 0.0}, {throw_to, rupture}};
    if (start < 0.0) knots.insert(knots.begin(), {start, -before});
    auto const times = of_drainage();
    for (std::size_t k = 0; k < times.size(); ++k) {
      double const share = static_cast<double>(k + 1) / static_cast<double>(times.size());
      knots.emplace_back(std::lerp(throw_to, end(throw_to), share), rupture + times[k]);
    }
    return TimeFunction(std::move(knots));
  }

 private:
  /// Times after the throw [s] at which steps end, increasing: a minute is among them.
  std::vector<double> of_drainage() const {
    std::vector<double> times;
    if (drainage == 0.0) return times;
    double const first = std::min(rupture / 100.0, drainage);
    double const steps = std::floor(per_decade * std::log10(drainage / first));
    for (double step = 0.0; step < steps; step += 1.0)
      times.push_back(drainage * std::pow(first / drainage, (steps - step) / steps));
    times.push_back(drainage);
    constexpr double minute = 60.0;
    auto const next = std::ranges::lower_bound(times, minute);
    if (next != times.end() && *next != minute) times.insert(next, minute);
    return times;
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

  /// What water carries of the ground at the start. \throws InputError for a void ratio that is not positive
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
         .begin = this->start() < 0.0 ? -2.0 * before : -before,
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

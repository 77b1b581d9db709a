// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "../print.hpp"
#include "built.hpp"
#include "preparation.hpp"
#include "scarp/rve/level_ground.hpp"

namespace examples {

/// Level ground of a sand, one packing for each depth [m]. Void ratio and relative density are those that the packing
/// has when it is compressed isotropically to the sand's pressure instead; it may be off by 0.01, over which packings
/// of few grains jump; a note tells it where it is by more than the sand's tolerance.
/// unit_weight [N/m3], surcharge [Pa]
/// \throws InputError, PreparationError
template <class PackingType>
scarp::PackingsByDepth<PackingType> level_ground(Sand const& sand, typename PackingType::Law const& law,
                                                 std::uint64_t seed, double unit_weight, double surcharge,
                                                 std::vector<double> depths, scarp::Buoyancy const& buoyancy = {}) {
  using Shape = typename PackingType::Shape;
  constexpr double off = 0.01;
  constexpr double least_friction = 0.005;  // without any, few grains at a low pressure may not come to rest
  if (depths.empty())
    scarp::reject("no depths of the ground's points are given (each point gets a packing of its own): give them");
  if (sand.vertical_pressure > 0.0)
    scarp::reject("the sand's vertical-pressure is {} Pa (ground has that of its depth): leave it out",
                  sand.vertical_pressure);
  if (sand.k0 > 0.0)
    scarp::reject(
        "the sand's k0 is {} (level ground comes to its own when it is compressed): give "
        "overconsolidation-ratio instead",
        sand.k0);
  scarp::LevelGround<SandGrading<Shape>> ground{.cloud = cloud_of<Shape>(sand, seed),
                                                .unit_weight = unit_weight,
                                                .surcharge = surcharge,
                                                .overconsolidation_ratio = sand.overconsolidation_ratio,
                                                .buoyancy = buoyancy};
  // The uppermost point may carry less than the preparation's usual pressure.
  double const least = ground.overburden(std::ranges::min(depths));
  ground.preparation.pressure = std::min(ground.preparation.pressure, least);
  double& friction = ground.preparation.preparation_friction;
  friction = sand.preparation_friction;
  if (sand.void_ratio > 0.0 || sand.relative_density > 0.0) {
    Consolidation<PackingType> const consolidation{
        ground.cloud.template make<PackingType>(), law, sand.pressure, ground.preparation.pressure, {}, least_friction};
    auto const made = reach_density(consolidation, sand, off);
    friction = made.friction;
    if (std::abs(made.void_ratio - made.wanted) > sand.void_ratio_tolerance)
      print_notes({fmt::format(
          "the ground has the void ratio {:.5f} where {:.5f} is wanted (seed {}): more grains, or another seed, come "
          "nearer",
          made.void_ratio, made.wanted, seed)});
  }
  return ground.template make<PackingType>(law, std::move(depths));
}

}  // namespace examples

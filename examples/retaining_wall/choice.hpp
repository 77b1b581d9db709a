// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <string>

namespace retaining_wall {

enum class Soil { sand, mohr_coulomb };

struct Choice {
  Soil soil = Soil::sand;
  int grains = 64;    ///< in each packing
  double size = 1.0;  ///< of the square cells [m]; divides height and length of the ground
  std::uint64_t seed = 1;
  double preparation_friction = 0.09;  ///< sets the density, hence the strength
  double strain = 0.03;                ///< wall displacement over the length of the ground, at the end
  int threads = 0;                     ///< 0: all cores
};

}  // namespace retaining_wall

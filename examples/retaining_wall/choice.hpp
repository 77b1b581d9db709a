// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "../shared/sand/sand.hpp"

namespace retaining_wall {

enum class Soil { sand, mohr_coulomb };

struct Choice {
  Soil soil = Soil::sand;
  std::string sand_file{};
  examples::Sand sand{
      .shape = "ellipse", .grains = 64, .preparation_friction = 0.09};  ///< of that file, but for options
  double size = 1.0;     ///< of the square cells [m]; divides height and length of the ground
  double strain = 0.03;  ///< wall displacement over the length of the ground, at the end
  int threads = 0;       ///< 0: all cores
};

}  // namespace retaining_wall

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <string>

namespace fault_slab {

enum class Soil { dem, mohr_coulomb };

/// Of the fault along its strike: dying out from the near to the far side, or the same everywhere.
enum class Slip { tapered, uniform };

/// What the user may choose.
struct Choice {
  Soil soil = Soil::dem;
  Slip slip = Slip::tapered;
  int elements = 1200;                      ///< wanted, of the whole slab
  int across = 8;                           ///< elements along the strike
  double strike = 50.0;                     ///< thickness of the slab [m]
  int grains = 100;                         ///< spheres in a packing
  std::uint64_t seed = 1;                   ///< of the packings
  double length = 8.0;                      ///< intrinsic [m], 0 for none
  double throw_over_depth = 0.085;          ///< on the near side at the end
  double tolerance = 1e-3;                  ///< residual of a load step
  double max_displacement_gradient = 0.01;  ///< of a load step
  int threads = 0;                          ///< 0: all
  int frames = 4;                           ///< VTU files over the run
  double time_limit = 0.0;                  ///< [s], 0 for none
  std::string checkpoint{};                 ///< folder; empty: none are made
  bool resume = false;
};

}  // namespace fault_slab

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <vector>

namespace preparations {

/// How a cloud of grains becomes the packing of a depth: isotropic consolidation at a first friction, where required
/// more of it at a second one, then the overburden at zero lateral strain at a third one, then rest at the law's own
/// friction.
struct Preparation {
  std::string path;                 ///< its kind, by the name that the page gives it
  double isotropic_pressure = 2e3;  ///< [Pa], one packing for all depths
  double isotropic_friction = 0.09;
  double share = 0.0;  ///< positive: then to this share of each depth's overburden, isotropic too
  double share_friction = 0.55;
  double vertical_friction = 0.55;       ///< while the overburden grows
  double overconsolidation_ratio = 1.0;  ///< largest overburden of the past over the present one
  double held_ratio = 0.0;               ///< positive: lateral over vertical stress is held, the lateral strain follows
  double laid = 0.0;      ///< particle fabric of the cloud: positive along the horizontal, negative along the vertical
  double fastest = 1e-5;  ///< strain per DEM step while the overburden grows
  bool tested = false;    ///< in a biaxial test too
};

/// All that are tried.
std::vector<Preparation> all_preparations();

}  // namespace preparations

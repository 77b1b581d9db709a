// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>

#include "mesh_directions.hpp"
#include "scarp/measure/measured.hpp"

namespace error_vs_time {

/// What a run of the free-field fault may be made with.
struct FaultSettings {
  double size = 5.0;  ///< of a cell in the band [m], see set_mesh
  MeshPattern pattern = MeshPattern::crossed;
  double aspect = 1.0;  ///< height of a cell over its width
  double length = 0.0;  ///< intrinsic [m]; 0: local
  double throw_over_depth = 0.02;
  int grains = 100;
  int packings = 1;  ///< columns of them; of several, points draw among the mirror images too
  std::uint64_t seed = 1;
  double tolerance = 1e-3;
  double largest_gradient = 0.005;
  double strain_per_step = 1e-5;
  int least_steps = 20;
  double inertial_number = 5e-3;
  double unbalanced = 0.05;
  double lazy = 0.0;            ///< tolerance of predicted answers; 0 asks always
  double most_seconds = 150.0;  ///< of the processor
};

/// The example's defaults on a coarser mesh with smaller packings, 220 triangles with 100 grains each, to a smaller throw, and
/// without the stiffness floor for packings that lose all contacts.
FaultSettings fault_rupture_defaults();

/// The free field with a packing in every triangle. Packings are prepared once for each mesh, number of grains and seed, outside of
/// the time that is measured.
/// repetition: moves the seed on
scarp::Measured sand_fault(FaultSettings const& settings, int repetition);

}  // namespace error_vs_time

// SPDX-License-Identifier: BSL-1.0
#include "pilot.hpp"

#include <algorithm>
#include <variant>

#include "../shared/print.hpp"
#include "run_scene.hpp"

namespace fault_rupture {

namespace {

/// What the coarse mesh resolves [m], in the reference study's ground.
constexpr double pilot_length = 5.0;

}  // namespace

void run_pilot(Choice& choice) {
  Choice pilot = choice;
  pilot.soil = Soil::mohr_coulomb;
  pilot.size = Choice{}.size * choice.scale();
  pilot.strip_width = 0.0;
  pilot.pattern.reset();  // one strip for meshes of all directions
  pilot.aspect = Choice{}.aspect;
  pilot.length = std::max(pilot_length * choice.scale(), 2.0 * choice.mesh_size);
  pilot.tolerance = 1e-3;
  pilot.max_displacement_gradient.reset();
  pilot.largest_time_error.reset();
  // Its rupture comes out where that of the reference study's sand does with a length of 2 m, within 1 m.
  pilot.peak_friction_angle = 35.0;
  pilot.peak_dilation_angle = 9.0;
  pilot.residual_friction_angle.reset();
  pilot.softening_strain = 0.5;
  pilot.young_modulus = Choice{}.young_modulus;
  pilot.k0 = Choice{}.k0;
  pilot.throw_over_depth = std::max(choice.throw_over_depth, Choice{}.throw_over_depth);  // before it, no band
  auto const scene = make_scene(pilot, ranks());
  choice.strained = std::visit([&](auto const& one) { return strained_by(pilot, one); }, scene);
  if (rank() == 0) examples::print(stderr, "pilot run: refines around {} strained elements\n", choice.strained.size());
}

}  // namespace fault_rupture

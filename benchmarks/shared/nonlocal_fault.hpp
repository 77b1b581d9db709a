// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../../examples/shared/study/sand_free_field.hpp"

namespace benchmarks {

/// The free-field fault with a nonlocal length of 8 m on a uniform mesh, otherwise the default run of fault_rupture.
/// quick: 220 triangles with 60 grains each, to h/H 0.002
inline fault_rupture::Choice nonlocal_fault(int packings, bool quick) {
  fault_rupture::Choice choice;
  choice.length = 8.0;
  choice.packings = packings;
  choice.mirrored_packings = packings > 1;
  fault_rupture::set_few_dem_steps(choice);
  if (quick) {
    choice.elements = 220;
    choice.grains = 60;
    choice.throw_over_depth = 0.002;
  }
  return choice;
}

/// The scene of a choice for a nonlocal soil of another type, whose provider is left.
/// study: the same choice with its own soil
template <class Scene>
Scene without_provider(fault_rupture::Choice const& choice, fault_rupture::SandFreeField const& study) {
  Scene scene;
  scene.soil.length = choice.length;
  scene.ground.layer = study.ground.layer;
  scene.fault = study.fault;
  scene.throw_to = study.throw_to;
  scene.stepping = study.stepping;
  scene.solver.tolerance = study.solver.tolerance;
  scene.solver.max_iterations = choice.max_iterations;
  return scene;
}

}  // namespace benchmarks

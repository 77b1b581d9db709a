// SPDX-License-Identifier: BSL-1.0
// The free field with a packing of the reference study's ellipses in every element.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/level_ground.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/solver/thread_executor.hpp"

int main() {
  using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  scarp::FreeFieldFault<scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>>> scene;
  scene.ground.layer.size = 8.0;
  scarp::LevelGround<scarp::EllipseGrading> ground;
  ground.cloud = {.grading = {.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75},
                  .grains = 64,
                  .density = 2650.0,
                  .thickness = 0.2};
  scene.soil.law = law;
  scene.soil.source = ground.make<Grains>(law, scene.soil_depths());
  scene.throw_to = 0.01;
  scene.solver.tolerance = 1e-2;
  scarp::ThreadExecutor executor;
  scarp::NoObserver no_observer;
  auto problem = scene.problem(executor);
  if (!scene.settle(problem, no_observer).verdict.acceptable()) return 1;
  return scene.rupture(problem, no_observer).verdict.acceptable() ? 0 : 1;
}

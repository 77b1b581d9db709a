// SPDX-License-Identifier: BSL-1.0
// The free field with Mohr-Coulomb ground.
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/solver/thread_executor.hpp"

using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;

int main() {
  scarp::FreeFieldFault<Soil, scarp::QuasiNewton<>> scene;
  scene.soil = {.elasticity = scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25),
                .strength = {{.cohesion = 1e3, .friction = 0.5}},
                .initial = {.surcharge = 4e3, .unit_weight = 15.68e3, .k0 = 0.4}};
  scene.solver.rule.exact.floor = 1e-4;  // of the elastic stiffness: a point that flows has none
  scene.throw_to = 0.02;
  scarp::ThreadExecutor executor;
  scarp::NoObserver no_observer;
  auto problem = scene.problem(executor);
  if (!scene.settle(problem, no_observer).verdict.acceptable()) return 1;
  return scene.rupture(problem, no_observer).verdict.acceptable() ? 0 : 1;
}

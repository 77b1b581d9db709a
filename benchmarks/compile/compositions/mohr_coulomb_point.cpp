// SPDX-License-Identifier: BSL-1.0
// One point of Mohr-Coulomb ground.
#include "scarp/constitutive/mohr_coulomb.hpp"

int main() {
  scarp::MohrCoulomb<2> const soil{.elasticity = scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25),
                                   .strength = {{.cohesion = 1e3, .friction = 0.5}}};
  scarp::Gradient<2> gradient = scarp::Gradient<2>::Zero();
  gradient(0, 1) = 1e-3;
  auto trial = soil.initial_state({});
  return soil.respond(soil.initial_state({}), gradient, trial).verdict.acceptable() ? 0 : 1;
}

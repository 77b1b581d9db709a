// SPDX-License-Identifier: BSL-1.0
// One point of linear elasticity: no grains, no elements.
#include "scarp/constitutive/linear_elastic.hpp"

int main() {
  auto const soil = scarp::LinearElastic<2>::from_lame(3e6, 2e6);
  scarp::Gradient<2> gradient = scarp::Gradient<2>::Zero();
  gradient(0, 1) = 1e-4;
  auto trial = soil.initial_state({});
  return soil.respond(soil.initial_state({}), gradient, trial).verdict.acceptable() ? 0 : 1;
}

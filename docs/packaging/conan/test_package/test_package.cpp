// SPDX-License-Identifier: BSL-1.0
// Asks linear elastic soil once: the stress of simple shear is shear modulus times shear strain, up to the
// square of that strain.
#include <fmt/format.h>

#include <cmath>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/core/version.hpp"

int main() {
  auto const soil = scarp::LinearElastic<2>::from_lame(3e6, 2e6);
  scarp::Gradient<2> gradient = scarp::Gradient<2>::Zero();
  double const strain = 1e-3;
  gradient(0, 1) = strain;
  scarp::LinearElastic<2>::State trial;
  double const shear_stress = soil.respond(soil.initial_state({}), gradient, trial).stress(2);
  fmt::print("scarp {}: shear stress {} Pa\n", scarp::version, shear_stress);
  return std::abs(shear_stress / (2e6 * strain) - 1.0) < strain * strain ? 0 : 1;
}

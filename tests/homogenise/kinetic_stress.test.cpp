// SPDX-License-Identifier: BSL-1.0
#include "scarp/homogenise/kinetic_stress.hpp"

#include <doctest/doctest.h>

#include "support/approx.hpp"
#include "support/packings.hpp"

TEST_CASE("moving grains carry a pressure of mass times velocity squared over the content") {
  scarp::Tensor<2> cell;
  cell << 0.1, 0.02, 0.0, 0.2;
  auto packing = samples::place<samples::SmoothDiscs>(cell, {{5e-3}, {2e-3}}, {{0.02, 0.05}, {0.07, 0.1}});
  CHECK(scarp::kinetic_stress(packing).isZero(0.0));
  packing.velocity(0, 0) = 3.0;
  packing.velocity(0, 1) = -2.0;
  packing.velocity(1, 1) = 5.0;
  // Analytic: -sum m v v / V.
  auto const mass = [](double radius) {
    return samples::density * samples::thickness * scarp::Disc::content({radius});
  };
  double const content = 0.1 * 0.2 * samples::thickness;
  auto const stress = scarp::kinetic_stress(packing);
  CHECK(stress(0, 0) == samples::Approx(-9.0 * mass(5e-3) / content).epsilon(1e-12));
  CHECK(stress(0, 1) == samples::Approx(6.0 * mass(5e-3) / content).epsilon(1e-12));
  CHECK(stress(1, 0) == stress(0, 1));
  CHECK(stress(1, 1) == samples::Approx(-(4.0 * mass(5e-3) + 25.0 * mass(2e-3)) / content).epsilon(1e-12));
}

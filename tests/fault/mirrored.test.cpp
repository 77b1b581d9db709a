// SPDX-License-Identifier: BSL-1.0
// The scene seen in a mirror, and with a length of zero.
#include <doctest/doctest.h>

#include <numbers>

#include "fault/mirror.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/strength.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/points/nonlocal.hpp"

namespace {

using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength>;
template <class SoilOfScene>
using Scene = scarp::FreeFieldFault<SoilOfScene, scarp::QuasiNewton<>, mirror::Ground, mirror::Fault>;

template <class SoilOfScene>
std::vector<scarp::Vector<2>> ruptured(SoilOfScene const& soil, bool mirrored) {
  Scene<SoilOfScene> scene;
  scene.soil = soil;
  scene.throw_to = 0.75;
  scene.solver.tolerance = 1e-10;
  scene.solver.rule.exact.floor = 1e-4;
  auto places = mirror::ruptured(scene, mirrored);
  REQUIRE_FALSE(places.empty());
  return places;
}

Soil softening_soil() {
  constexpr double degree = std::numbers::pi / 180.0;
  Soil soil;
  soil.elasticity = scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3);
  soil.strength = {.peak = {.cohesion = 1e3, .friction = 31.0 * degree, .dilation = 7.0 * degree},
                   .residual = {.cohesion = 1e3, .friction = 26.0 * degree, .dilation = 0.0},
                   .softening_strain = 0.15};
  soil.initial = {.surcharge = 4e3, .unit_weight = 15.68e3, .k0 = 0.4};
  return soil;
}

std::vector<scarp::Vector<2>> ruptured(double length, bool mirrored) {
  return ruptured(scarp::Nonlocal<Soil>{.provider = softening_soil(), .length = length}, mirrored);
}

}  // namespace

TEST_CASE("the mirrored scene gives the mirrored answer, without a length and with one") {
  using mirror::largest_difference;
  auto const local = ruptured(0.0, false);
  auto const averaged = ruptured(8.0, false);
  // Residuals of 1e-10 leave errors of a micrometre where the soil softens; the throw is 0.75 m.
  CHECK(largest_difference(local, ruptured(0.0, true)) < 1e-6);
  CHECK(largest_difference(averaged, ruptured(8.0, true)) < 1e-6);
  CHECK(largest_difference(local, averaged) > 0.01);
}

TEST_CASE("a scene with a length of zero is the scene without one, bit for bit") {
  CHECK(ruptured(0.0, false) == ruptured(softening_soil(), false));
}

// SPDX-License-Identifier: BSL-1.0
// The scene seen in a mirror.
#include <doctest/doctest.h>

#include <numbers>

#include "fault/mirror.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/softening_strength.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/scene/nonlocal_scene.hpp"
#include "scarp/solver/consistent_tangent.hpp"

namespace {

using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength>;
using Scene = scarp::FreeFieldFault<scarp::Nonlocal<Soil>, scarp::QuasiNewton<scarp::ConsistentTangent>, mirror::Ground,
                                    mirror::Fault>;

std::vector<scarp::Vector<2>> ruptured(double length, bool mirrored) {
  constexpr double degree = std::numbers::pi / 180.0;
  Scene scene;
  scene.soil.provider.elasticity = scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3);
  scene.soil.provider.strength = {.peak = {.cohesion = 1e3, .friction = 31.0 * degree, .dilation = 7.0 * degree},
                                  .residual = {.cohesion = 1e3, .friction = 26.0 * degree, .dilation = 0.0},
                                  .strain_to_residual = 0.15};
  scene.soil.provider.initial = {scene.surcharge, scene.unit_weight, 0.4};
  scene.soil.length = length;
  scene.throw_to = 0.75;
  scene.solver.tolerance = 1e-10;
  scene.solver.rule.floor = 1e-4;
  auto places = mirror::ruptured(scene, mirrored);
  REQUIRE_FALSE(places.empty());
  return places;
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

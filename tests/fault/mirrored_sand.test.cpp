// SPDX-License-Identifier: BSL-1.0
// The scene in sand, seen in a mirror with its packings.
#include <doctest/doctest.h>

#include "fault/mirror.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/dem/mirrored.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/level_ground.hpp"
#include "support/packings.hpp"

namespace {

using Grains = samples::Ellipses;
using Sand = scarp::StiffnessFloor<scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>>>;
using Scene = scarp::FreeFieldFault<scarp::Nonlocal<Sand>, scarp::QuasiNewton<>, mirror::Ground, mirror::Fault>;

std::vector<scarp::Vector<2>> ruptured(bool mirrored_scene, bool mirrored_packings) {
  Scene scene;
  scene.ground.layer.size = 6.0;
  scene.ground.layer.jitter = 0.0;
  scene.soil.length = 12.0;
  scene.throw_to = 0.2;
  scene.solver.tolerance = 1e-4;
  scene.stepping.max_displacement_gradient = 0.005;
  scarp::LevelGround<scarp::EllipseGrading> ground;
  ground.cloud = {.grading = samples::grading<Grains>(),
                  .grains = 40,
                  .density = samples::density,
                  .thickness = samples::thickness};
  auto& soil = scene.soil.provider.provider;
  soil.law = samples::study_law();
  soil.pressure_floor = 2e3;
  soil.source = ground.make<Grains>(soil.law, scene.soil_depths());
  for (auto& packing : soil.source.packings) {
    if (mirrored_packings) packing = scarp::mirrored(std::move(packing));
  }
  auto places = mirror::ruptured(scene, mirrored_scene);
  REQUIRE_FALSE(places.empty());
  return places;
}

}  // namespace

TEST_CASE("the mirrored scene with mirrored packings gives the mirrored answer as far as damping is symmetric") {
  auto const seen = ruptured(false, false);
  double const apart = mirror::largest_difference(seen, ruptured(true, true));
  double const with_the_same_packings = mirror::largest_difference(seen, ruptured(true, false));
  MESSAGE("throw 0.2 m: places differ by " << apart << " m, with packings as they were by " << with_the_same_packings
                                           << " m");
  CHECK(apart < 1e-3);
  CHECK(with_the_same_packings > 10.0 * apart);
}

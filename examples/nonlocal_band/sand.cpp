// SPDX-License-Identifier: BSL-1.0
#include "../shared/study/soils.hpp"
#include "fault_rows.hpp"

namespace nonlocal_band {

namespace {

using fault_rupture::Sand;

struct Soil : scarp::Nonlocal<Sand> {};
struct Scene : scarp::FreeFieldFault<Soil, Sand::Solver> {};

}  // namespace

void print_sand(FaultChoice const& choice, int grains, std::uint64_t seed) {
  print_rows(choice, [&](double size) {
    Scene scene;
    scene.ground.layer.size = size;
    scene.stepping.max_displacement_gradient = Sand::max_displacement_gradient(false);
    fault_rupture::Choice sand;
    sand.grains = grains;
    sand.seed = seed;
    scene.soil.provider = fault_rupture::make_sand(sand, scene.soil_sites());
    return scene;
  });
}

}  // namespace nonlocal_band

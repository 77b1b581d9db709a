// SPDX-License-Identifier: BSL-1.0
#include "../shared/study/soils.hpp"
#include "fault_rows.hpp"

namespace nonlocal_band {

namespace {

using fault_rupture::FrictionalSoil;

struct Soil : scarp::Nonlocal<FrictionalSoil> {};
struct Scene : scarp::FreeFieldFault<Soil, FrictionalSoil::Solver> {};

}  // namespace

void print_fault(FaultChoice const& choice) {
  print_rows(choice, [](double size) {
    Scene scene;
    scene.soil.provider = fault_rupture::make_frictional_soil();
    scene.ground.layer.size = size;
    scene.solver.rule.floor = 1e-4;
    scene.stepping.max_displacement_gradient = 0.02;
    return scene;
  });
}

}  // namespace nonlocal_band

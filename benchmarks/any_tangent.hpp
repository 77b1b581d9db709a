// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>

#include "../examples/shared/study/typed_scenes.hpp"

namespace fault_benchmarks {

using Grains = fault_rupture::Grains;

/// Any policy under one type, so that the scene is compiled once for each solver.
struct AnyTangent {
  std::function<scarp::VoigtTangent<2>(Grains const&, Grains::Law const&)> policy;

  scarp::VoigtTangent<2> operator()(Grains const& packing, Grains::Law const& law) const {
    return policy(packing, law);
  }
};

using Soil = scarp::DemRve<Grains, fault_rupture::Columns, AnyTangent>;

/// The study's scene with another tangent and solver.
template <class Solver>
scarp::FreeFieldFault<Soil, Solver> scene_of(fault_rupture::SandFreeField const& study, AnyTangent const& tangent,
                                             Solver const& solver) {
  scarp::FreeFieldFault<Soil, Solver> scene;
  auto const& packings = study.soil.provider;
  scene.soil.law = packings.law;
  scene.soil.source = packings.source;
  scene.soil.strain_per_step = packings.strain_per_step;
  scene.soil.least_steps = packings.least_steps;
  scene.soil.unbalanced_tolerance = packings.unbalanced_tolerance;
  scene.soil.loose_pressure = packings.loose_pressure;
  scene.soil.tangent_policy = tangent;
  scene.ground.layer = study.ground.layer;
  scene.fault = study.fault;
  scene.throw_to = study.throw_to;
  scene.stepping = study.stepping;
  scene.solver = solver;
  return scene;
}

}  // namespace fault_benchmarks

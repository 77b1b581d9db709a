// SPDX-License-Identifier: BSL-1.0
#include "fault_runs.hpp"

#include <map>
#include <tuple>

#include "../../examples/shared/study/typed_scenes.hpp"
#include "fault_answers.hpp"
#include "scarp/constitutive/lazy.hpp"
#include "scarp/scene/nonlocal_scene.hpp"

namespace error_vs_time {

namespace {

using Packings = scarp::DemRve<fault_rupture::Grains, fault_rupture::Columns>;

struct LazySand : scarp::Lazy<Packings> {};
struct NonlocalSand : scarp::Nonlocal<LazySand> {};

using fault_rupture::SandFreeField;

/// Packings are the same for all runs of one seed, so that they are prepared once.
SandFreeField const& prepared(FaultSettings const& settings, std::uint64_t seed) {
  static std::map<std::tuple<double, MeshPattern, double, int, int, std::uint64_t>, SandFreeField> made;
  std::tuple const key{settings.size, settings.pattern, settings.aspect, settings.grains, settings.packings, seed};
  auto const found = made.find(key);
  if (found != made.end()) return found->second;
  fault_rupture::Choice choice;
  set_mesh(choice, settings.size, settings.pattern, settings.aspect);
  choice.grains = settings.grains;
  choice.packings = settings.packings;
  choice.mirrored_packings = settings.packings > 1;
  choice.seed = seed;
  return made.emplace(key, fault_rupture::make<SandFreeField>(choice)).first->second;
}

LazySand sand_of(SandFreeField const& study, FaultSettings const& settings) {
  LazySand soil;
  auto& sand = soil.provider;
  sand.law = study.soil.provider.law;
  sand.source = study.soil.provider.source;
  sand.strain_per_step = settings.strain_per_step;
  sand.least_steps = settings.least_steps;
  sand.inertial_number = settings.inertial_number;
  sand.unbalanced_tolerance = settings.unbalanced;
  sand.loose_pressure = study.soil.provider.loose_pressure;
  soil.tolerance = settings.lazy;
  soil.loose_pressure = study.soil.provider.loose_pressure;
  return soil;
}

template <class Soil>
scarp::Measured run_with(Soil const& soil, SandFreeField const& study, FaultSettings const& settings) {
  scarp::FreeFieldFault<Soil, scarp::QuasiNewton<>> scene;
  scene.soil = soil;
  scene.ground.layer = study.ground.layer;
  scene.fault = study.fault;
  scene.throw_to = settings.throw_over_depth * scene.ground.layer.depth;
  scene.solver.tolerance = settings.tolerance;
  scene.stepping.largest_gradient = settings.largest_gradient;
  static scarp::SerialExecutor executor;
  return run_fault(scene, executor, settings.most_seconds);
}

}  // namespace

FaultSettings fault_rupture_defaults() {
  fault_rupture::Choice const choice;
  return {.tolerance = fault_rupture::Sand::tolerance(choice),
          .largest_gradient = fault_rupture::Sand::largest_gradient(choice.quick),
          .strain_per_step = choice.strain_per_step,
          .least_steps = choice.least_dem_steps,
          .unbalanced = choice.unbalanced_tolerance};
}

scarp::Measured sand_fault(FaultSettings const& settings, int repetition) {
  auto const& study = prepared(settings, settings.seed + static_cast<std::uint64_t>(repetition));
  if (settings.length > 0.0) {
    NonlocalSand soil;
    soil.provider = sand_of(study, settings);
    soil.length = settings.length;
    return run_with(soil, study, settings);
  }
  return run_with(sand_of(study, settings), study, settings);
}

}  // namespace error_vs_time

// SPDX-License-Identifier: BSL-1.0
#include "fault_runs.hpp"

#include <map>
#include <tuple>

#include "../any_tangent.hpp"
#include "fault_answers.hpp"
#include "scarp/constitutive/lazy.hpp"
#include "scarp/homogenise/condensed_tangent.hpp"
#include "scarp/scene/nonlocal_scene.hpp"
#include "scarp/solver/bfgs_mixing.hpp"
#include "scarp/solver/dynamic_relaxation.hpp"
#include "scarp/solver/frozen_tangent.hpp"

namespace error_vs_time {

namespace {

using fault_benchmarks::AnyTangent;

struct LazySand : scarp::Lazy<fault_benchmarks::Soil> {};
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
  sand.tangent_policy =
      settings.condensed ? AnyTangent{scarp::CondensedTangent{}} : AnyTangent{scarp::ElasticContactTangent{}};
  soil.tolerance = settings.lazy;
  soil.loose_pressure = study.soil.provider.loose_pressure;
  return soil;
}

template <class Soil, class Solver>
scarp::Measured run_with(Soil const& soil, Solver solver, scarp::LoadStepping stepping, SandFreeField const& study,
                         FaultSettings const& settings) {
  scarp::FreeFieldFault<Soil, Solver> scene;
  scene.soil = soil;
  scene.ground.layer = study.ground.layer;
  scene.fault = study.fault;
  scene.throw_to = settings.throw_over_depth * scene.ground.layer.depth;
  solver.tolerance = settings.tolerance;
  scene.solver = solver;
  scene.stepping = stepping;
  scene.stepping.largest_gradient = settings.largest_gradient;
  static scarp::SerialExecutor executor;
  return run_fault(scene, executor, settings.most_seconds);
}

scarp::Measured with_length(SandFreeField const& study, FaultSettings const& settings) {
  if (settings.solver != FaultSolver::point_secant) {
    scarp::refuse("a length of {} m goes with the point secant only (others are not compiled with it): choose it",
                  settings.length);
  }
  NonlocalSand soil;
  soil.provider = sand_of(study, settings);
  soil.length = settings.length;
  return run_with(soil, scarp::QuasiNewton<>{}, {}, study, settings);
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
  using scarp::PlainStep;
  using scarp::PointSecant;
  using scarp::QuasiNewton;
  auto const& study = prepared(settings, settings.seed + static_cast<std::uint64_t>(repetition));
  if (settings.length > 0.0) return with_length(study, settings);
  auto const sand = sand_of(study, settings);
  switch (settings.solver) {
    case FaultSolver::point_secant: return run_with(sand, QuasiNewton<>{}, {}, study, settings);
    case FaultSolver::along_iterates: {
      using Solver = QuasiNewton<PointSecant, PlainStep, scarp::SparseLu, scarp::AlongIterates>;
      return run_with(sand, Solver{.most_iterations = 60}, {.few = 12, .many = 20}, study, settings);
    }
    case FaultSolver::frozen_bfgs:
      return run_with(sand, QuasiNewton<scarp::FrozenTangent, scarp::BfgsMixing>{}, {}, study, settings);
    case FaultSolver::relaxation: {
      FaultSettings own = settings;
      own.least_steps = std::min(settings.least_steps, 4);  // as docs/solvers.md has it
      return run_with(sand_of(study, own), scarp::DynamicRelaxation<>{}, {.few = 150, .many = 300}, study, own);
    }
  }
  scarp::refuse("there is no such solver of the fault scene: choose one of FaultSolver");
}

}  // namespace error_vs_time

// SPDX-License-Identifier: BSL-1.0
#include "../../examples/shared/study/typed_scenes.hpp"

#include "fault_answers.hpp"
#include "fault_runs.hpp"
#include "scarp/measure/sweep.hpp"
#include "scarp/scene/nonlocal_scene.hpp"
#include "subjects.hpp"

namespace error_vs_time {

namespace {

using Newton = scarp::QuasiNewton<scarp::ConsistentTangent>;
struct NonlocalSoil : scarp::Nonlocal<fault_rupture::FrictionalSoil> {};
struct FootingOnSoil : scarp::FaultScene<NonlocalSoil, fault_rupture::RigidFooting, Newton> {};

/// A mesh and settings of a fault in ground that is cheap to ask.
struct GroundSettings {
  double size = 2.5;  ///< of a cell in the band [m], see set_mesh
  MeshPattern pattern = MeshPattern::crossed;
  double aspect = 1.0;  ///< height of a cell over its width
  double throw_over_depth = 0.02;
  double largest_gradient = 0.02;
  double tolerance = 1e-10;
  double length = 0.0;  ///< intrinsic [m]; 0: local
  double most_seconds = 100.0;
};

fault_rupture::Choice choice_of(GroundSettings const& settings) {
  fault_rupture::Choice choice;
  set_mesh(choice, settings.size, settings.pattern, settings.aspect);
  choice.throw_over_depth = settings.throw_over_depth;
  choice.largest_gradient = settings.largest_gradient;
  choice.tolerance = settings.tolerance;
  return choice;
}

/// The free field of a soil that is a formula.
template <class Scene>
scarp::Measured free_field(GroundSettings const& settings) {
  static scarp::SerialExecutor executor;
  return run_fault(fault_rupture::make<Scene>(choice_of(settings)), executor, settings.most_seconds);
}

/// The heavy footing, rigid and frictional, on softening Mohr-Coulomb ground.
scarp::Measured footing(GroundSettings const& settings) {
  auto choice = choice_of(settings);
  choice.scene = fault_rupture::Case::heavy;
  auto const made = fault_rupture::make<fault_rupture::MohrCoulombFrictionalFooting>(choice);
  FootingOnSoil scene;
  scene.soil.provider = made.soil;
  scene.soil.length = settings.length;
  scene.ground.layer = made.ground.layer;
  scene.fault = made.fault;
  scene.unit_weight = made.unit_weight;
  scene.surcharge = made.surcharge;
  scene.throw_to = made.throw_to;
  scene.solver = made.solver;
  scene.stepping = made.stepping;
  scene.structure = made.structure;
  static scarp::SerialExecutor executor;
  return run_fault(scene, executor, settings.most_seconds);
}

template <class SceneType>
struct Ground {
  using Scene = SceneType;
};

/// The same fault in the same mesh, the ground once a packing in every triangle and once a formula.
scarp::SweepTable providers(Options const& options) {
  FaultSettings base = fault_rupture_defaults();
  base.throw_over_depth = 0.04;
  if (options.quick) base.throw_over_depth = 0.002;
  scarp::Sweep sweep("providers", base, sand_fault);
  auto finer = base;
  finer.largest_gradient = base.largest_gradient / 2.0;
  sweep.reference(finer);
  sweep.vary_over<Ground<fault_rupture::MohrCoulombFreeField>, Ground<fault_rupture::ElasticFreeField>>(
      "provider", {"Mohr-Coulomb", "elastic"}, [](auto ground, FaultSettings const& settings) {
        return free_field<typename decltype(ground)::Scene>(
            {.size = settings.size, .throw_over_depth = settings.throw_over_depth});
      });
  return sweep.run(options.repetitions_or(options.quick ? 1 : 2));
}

/// Softening ground below the heavy footing. Load steps, tolerances and directions of the mesh are judged on the finest mesh, meshes
/// with the finest steps.
scarp::SweepTable mohr_coulomb(Options const& options, double length) {
  double const half = options.quick ? 2.0 : 1.0;
  GroundSettings const base{.size = (length > 0.0 ? 3.5 : 2.5) * half, .length = length};
  scarp::Sweep sweep("Mohr-Coulomb fault with a footing", base, footing);
  auto fine = base;
  fine.size = base.size / 1.4;
  fine.largest_gradient = base.largest_gradient / 8.0;
  sweep.reference(fine);
  sweep.vary("cell in the band [m], finest step",
             [fine](GroundSettings& settings, double size) {
               settings = fine;
               settings.size = size;
             },
             {2.8 * base.size, 2.0 * base.size, 1.4 * base.size, base.size});
  sweep.vary("gradient of a load step, finest mesh",
             [fine](GroundSettings& settings, double gradient) {
               settings = fine;
               settings.largest_gradient = gradient;
             },
             {0.08, 0.04, 0.02, 0.01, 0.005});
  sweep.vary("force tolerance, finest mesh",
             [fine](GroundSettings& settings, double tolerance) {
               settings = fine;
               settings.largest_gradient = 0.02;
               settings.tolerance = tolerance;
             },
             {1e-2, 1e-3, 1e-4, 1e-6});
  sweep.vary("aspect of a cell, finest mesh and step",
             [fine](GroundSettings& settings, double aspect) {
               settings = fine;
               settings.aspect = aspect;
             },
             {1.73, 2.5});
  sweep.vary_over<LeftPattern, RightPattern, JitteredPattern>(
      "pattern, finest mesh and step", {"left", "right", "jittered"}, [fine](auto pattern, GroundSettings const&) {
        auto settings = fine;
        settings.pattern = pattern.value;
        return footing(settings);
      });
  if (length > 0.0) {
    double const cells = length / fine.size;
    sweep.vary(
        "length [m], as many cells in it, finest step",
        [fine, cells](GroundSettings& settings, double shorter) {
          settings = fine;
          settings.length = shorter;
          settings.size = shorter / cells;
        },
        options.quick ? std::vector{11.3} : std::vector{5.66, 4.0});
  }
  return sweep.run(options.repetitions_or(1));
}

scarp::SweepTable local_ground(Options const& options) { return mohr_coulomb(options, 0.0); }
scarp::SweepTable nonlocal_ground(Options const& options) { return mohr_coulomb(options, 8.0); }

bool const registered_providers = register_subject(
    {.name = "fault_providers",
     .question = "what do Mohr-Coulomb and elastic ground cost in the fault scene, and what do they miss?",
     .run = providers});
bool const registered_local =
    register_subject({.name = "fault_mohr_coulomb",
                      .question = "mesh, load steps and tolerance of a footing on softening ground above a fault",
                      .run = local_ground});
bool const registered_nonlocal = register_subject({.name = "fault_mohr_coulomb_nonlocal",
                                                   .question = "the same with an intrinsic length of 8 m",
                                                   .run = nonlocal_ground});

}  // namespace

}  // namespace error_vs_time

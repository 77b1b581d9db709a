// SPDX-License-Identifier: BSL-1.0
// The reference study's scene with all that may be part of it: a footing that may slide and lift, a nonlocal length,
// observers, checkpoints, and ranks where there is an MPI.
#include <filesystem>

#include "../../../examples/fault_rupture/footing_log.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/fault/frictional_footing.hpp"
#include "scarp/fault/surface_log.hpp"
#include "scarp/observe/convergence_log.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/run/checkpointed_run.hpp"
#include "scarp/run/root_rank.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/level_ground.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/solver/thread_executor.hpp"
#if __has_include(<mpi.h>)
#include "scarp/solver/rank_executor.hpp"
#endif

namespace {

using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Sand = scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>>;
using Scene = scarp::FaultScene<scarp::Nonlocal<Sand>, scarp::FrictionalFooting<>>;

Scene make_scene() {
  Scene scene;
  scene.ground.layer.size = 12.0;
  scene.throw_to = 0.05;
  scene.solver.tolerance = 5e-3;
  scene.structure.footing = {.centre = -10.5, .width = 10.0, .bearing = 37e3};
  scene.structure.interface = {.normal_stiffness = 1e8, .tangential_stiffness = 1e8, .friction = 0.5};
  Sand sand;
  sand.law = {.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  sand.pressure_floor = scene.surcharge / 4.0;
  scarp::LevelGround<scarp::EllipseGrading> const ground{{{4e-3, 6e-3, 0.75}, 36, 2650.0, 0.2}};
  sand.source = ground.make<Grains>(sand.law, scene.soil_depths());
  scene.soil = {.provider = sand, .length = 6.0};
  return scene;
}

auto observers(Scene const& scene, std::filesystem::path const& folder) {
  constexpr int frames = 4;
  double const depth = scene.ground.layer.depth;
  return scarp::Observers(
      scarp::FieldSeries(folder, {.to = scene.throw_to, .count = frames, .unit = depth}),
      scarp::SurfaceLog(folder / "surface.csv", scene.throw_to, frames, depth),
      fault_rupture::FootingLog(folder, scene.structure, scene.throw_to, frames, depth),
      scarp::ConvergenceLog(folder / "convergence.csv", scarp::LoadMeasure{depth, "throw_over_depth"}));
}

/// What a program has to save of itself.
struct Nothing {
  template <class Self, class Visit>
  static void members(Self&, Visit&&) {}
};

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path const folder = argc > 1 ? argv[1] : "full_scene";
  std::filesystem::create_directories(folder / "fields");
  auto const scene = make_scene();
  scarp::ThreadExecutor threads(1);
#if __has_include(<mpi.h>)
  scarp::MpiSession const session(argc, argv);
  scarp::RankExecutor executor(threads);
#else
  auto& executor = threads;
#endif
  auto problem = scene.problem(executor);
  scarp::OnRootRank watching(executor, [&] { return observers(scene, folder); });
  Nothing notes;
  scarp::CheckpointFiles files({.folder = folder / "states", .every_attempts = 1}, "the full scene\n");
  scarp::CheckpointedRun run(files, watching, notes);
  run.stage([&] { return scene.settle(problem, run); });
  run.stage([&] { return scene.place(problem, run); });
  run.stage([&] { return scene.rupture(problem, run); });
  return run.report().verdict.acceptable() ? 0 : 1;
}

// SPDX-License-Identifier: BSL-1.0
// The study's scene with all that may be part of it: a footing that may slide and lift, an intrinsic length, observers,
// checkpoints, and ranks where there is an MPI. Each can be left out (-D WITHOUT_FOOTING and so on): benchmarks/absence/run.
//   full_scene FOLDER
#include <fmt/format.h>
#include <malloc.h>

#include <filesystem>

#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/packings_by_depth.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/ellipse_grading.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/fault/level_ground.hpp"
#include "scarp/solver/thread_executor.hpp"
#ifndef WITHOUT_FOOTING
#include "scarp/fault/footing_log.hpp"
#include "scarp/fault/frictional_footing.hpp"
#endif
#ifndef WITHOUT_LENGTH
#include "scarp/scene/nonlocal_scene.hpp"
#endif
#ifndef WITHOUT_OBSERVERS
#include "scarp/observe/convergence_log.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/observe/surface_log.hpp"
#endif
#ifndef WITHOUT_CHECKPOINTS
#include "scarp/run/checkpointed_run.hpp"
#endif
#if !defined(WITHOUT_RANKS) && __has_include(<mpi.h>)
#define HAS_RANKS
#include "scarp/run/first_rank.hpp"
#include "scarp/solver/rank_executor.hpp"
#endif

namespace {

using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Sand = scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>>;
#ifdef WITHOUT_LENGTH
using Soil = Sand;
#else
using Soil = scarp::Nonlocal<Sand>;
#endif
#ifdef WITHOUT_FOOTING
using Structure = scarp::BareGround;
#else
using Structure = scarp::FrictionalFooting<>;
#endif
using Scene = scarp::FaultScene<Soil, Structure>;

Scene make_scene() {
  Scene scene;
  scene.ground.layer.size = 12.0;
  scene.throw_to = 0.05;
  scene.solver.tolerance = 5e-3;
#ifndef WITHOUT_FOOTING
  scene.structure.footing = {.centre = -10.5, .width = 10.0, .bearing = 37e3};
  scene.structure.interface = {.normal_stiffness = 1e8, .tangential_stiffness = 1e8, .friction = 0.5};
#endif
  Sand sand;
  sand.law = {.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  sand.loose_pressure = scene.surcharge / 4.0;
  scarp::LevelGround<scarp::EllipseGrading> const ground{{{4e-3, 6e-3, 0.75}, 36, 2650.0, 0.2}};
  sand.source = ground.make<Grains>(sand.law, scene.soil_depths());
#ifdef WITHOUT_LENGTH
  scene.soil = sand;
#else
  scene.soil = {.provider = sand, .length = 6.0};
#endif
  return scene;
}

#ifndef WITHOUT_OBSERVERS
auto observers(Scene const& scene, std::filesystem::path const& folder) {
  constexpr int frames = 4;
  double const depth = scene.ground.layer.depth;
  return scarp::Observers(scarp::FieldSeries<scarp::RveQuantities>(folder, scene.throw_to, frames, depth),
                          scarp::SurfaceLog(folder / "surface.csv", scene.throw_to, frames, depth),
#ifndef WITHOUT_FOOTING
                          scarp::FootingLog(folder, scene.structure, scene.throw_to, frames, depth),
#endif
                          scarp::ConvergenceLog(folder / "convergence.csv", depth));
}
#endif

/// What a program has to save of itself, and as an observer of nothing.
struct Nothing : scarp::NoObserver {
  template <class Self, class Visit>
  static void members(Self&, Visit&&) {}
};

/// All but the preparation; what benchmarks/absence/run counts the instructions of.
template <class Problem, class Watching>
[[gnu::noinline]] scarp::RunReport measured_run(Scene const& scene, Problem& problem, Watching& watching,
                                                [[maybe_unused]] std::filesystem::path const& folder) {
#ifdef WITHOUT_CHECKPOINTS
  auto report = scene.settle(problem, watching);
  if (report.verdict.acceptable()) report = joined(report, scene.place(problem, watching));
  if (report.verdict.acceptable()) report = joined(report, scene.rupture(problem, watching));
  return report;
#else
  Nothing notes;
  scarp::CheckpointFiles files({.folder = folder / "states", .every_attempts = 1}, "the full scene\n");
  scarp::CheckpointedRun run(files, watching, notes);
  run.stage([&] { return scene.settle(problem, run); });
  run.stage([&] { return scene.place(problem, run); });
  run.stage([&] { return scene.rupture(problem, run); });
  return run.report();
#endif
}

std::size_t heap_bytes() {
  auto const used = mallinfo2();
  return used.uordblks + used.hblkhd;
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path const folder = argc > 1 ? argv[1] : "full_scene";
#ifdef HAS_RANKS
  scarp::MpiSession const session(argc, argv);
#endif
  std::filesystem::create_directories(folder / "fields");
  auto const scene = make_scene();
  scarp::ThreadExecutor threads(1);
#ifdef HAS_RANKS
  scarp::RankExecutor executor(threads);
#else
  auto& executor = threads;
#endif
  std::size_t const before = heap_bytes();
  auto problem = scene.problem(executor);
  std::size_t const heap = heap_bytes() - before;
#if defined(WITHOUT_OBSERVERS)
  Nothing watching;
#elif defined(HAS_RANKS)
  scarp::OnFirstRank watching(executor, [&] { return observers(scene, folder); });
#else
  auto watching = observers(scene, folder);
#endif
  auto const report = measured_run(scene, problem, watching, folder);
  fmt::print(
      "{{\"ended\": \"{}\", \"points\": {}, \"grains\": 36, \"heap\": {}, \"dem_steps\": {}, \"iterations\": {}}}\n",
      name(report.verdict.status), problem.materials().point_count(), heap, report.inner_steps, report.iterations);
  return report.verdict.acceptable() ? 0 : 1;
}

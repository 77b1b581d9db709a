// SPDX-License-Identifier: BSL-1.0
#include "fault.hpp"

#include "../shared/convergence_table.hpp"
#include "../shared/print.hpp"
#include "../shared/study/soils.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/fault/rupture_measures.hpp"
#include "scarp/observe/totals.hpp"
#include "scarp/points/nonlocal.hpp"

namespace nonlocal_band {

namespace {

using fault_rupture::FrictionalSoil;

struct Ground : scarp::Nonlocal<FrictionalSoil> {};  // a length of zero makes it local, bit for bit
struct Scene : scarp::FreeFieldFault<Ground> {};

Scene scene_of(FaultChoice const& choice, double size, double length) {
  Scene scene;
  scene.soil.provider = fault_rupture::make_frictional_soil();
  scene.soil.length = length;
  scene.soil.stiffness = choice.stiffness;
  scene.soil.fading = choice.fading;
  scene.ground.layer.size = size;
  scene.throw_to = choice.throw_over_depth * scene.ground.layer.depth;
  scene.solver.rule.exact.floor = 1e-4;
  scene.solver.tolerance = choice.tolerance;
  scene.stepping.max_displacement_gradient = 0.02;
  return scene;
}

}  // namespace

void print_fault(FaultChoice const& choice) {
  examples::print(stdout, "{:>6} {:>9} {:>6} {:>8} {:>10} {:>9} {:>12} {:>6} {:>8} {:>6} {:>7}\n", "size", "triangles",
                  "l", "throw", "outcrop", "width", "reaction", "steps", "rejected", "iter", "s");
  scarp::SerialExecutor executor;
  for (double const length : choice.lengths) {
    for (double const size : choice.sizes) {
      auto const scene = scene_of(choice, size, length);
      examples::Stopwatch const watch;
      auto problem = scene.problem(executor);
      scarp::NoObserver no_observer;
      auto const settled = scene.settle(problem, no_observer);
      double const at_rest = scarp::generalised_reaction(problem);
      auto const rest = scarp::ground_at_rest(problem);
      auto const run = settled.verdict.acceptable() ? scene.rupture(problem, no_observer) : settled;
      auto const& grid = problem.discretisation();
      auto const found = scarp::outcrop(scarp::surface_profile(grid.mesh(), rest.of(grid.nodes()), grid.positions()),
                                        {.hanging = run.load});
      examples::print(stdout, "{:6} {:9} {:6} {:8.4f} {:10.2f} {:9.2f} {:12.5g} {:6} {:8} {:6} {:7.1f}  {}\n", size,
                      grid.mesh().elements.size(), length, run.load, found.outcrop_x, found.width,
                      scarp::generalised_reaction(problem) - at_rest, run.steps, run.refused, run.iterations,
                      watch.seconds(), run.verdict.acceptable() ? "" : name(run.last_failure));
      std::fflush(stdout);
    }
  }
}

}  // namespace nonlocal_band

// SPDX-License-Identifier: BSL-1.0
// in_space ELEMENTS GRAINS: the free field as a slab of hexahedra with a packing of spheres in each of their points, a
// few load steps; what they took, as JSON on stdout.
#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdlib>
#include <exception>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/element/hex8.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/run/resources.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/level_ground.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/sphere.hpp"

namespace {

using Spheres = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;
struct Sand : scarp::DemRve<Spheres, scarp::PackingsByDepth<Spheres>> {};
using Scene = scarp::FreeFieldFault<Sand, scarp::QuasiNewton<>, scarp::StructuredGround<scarp::Hex8>>;

/// Time outside of the points, over all attempts.
struct Outside : scarp::NeverStops {
  double seconds = 0.0;
  double in_points = 0.0;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const& report) {
    seconds += report.seconds;
    for (auto const& record : report.history) in_points += record.material_seconds;
  }
};

void measure(int elements, int grains) {
  Scene scene;
  scene.ground.layer = scene.ground.layer.with_about<scarp::Hex8>(elements);
  scene.throw_to = 3e-3;
  scene.solver.tolerance = 1e-3;
  scarp::LinearFrictional const law{.normal_stiffness = 1e6, .tangential_stiffness = 5e5, .friction = 0.5};
  scarp::LevelGround<scarp::SphereGrading> ground;
  ground.cloud = {.grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = grains, .density = 2650.0, .seed = 1};
  scarp::CpuTime const preparing;
  scene.soil.law = law;
  scene.soil.source = ground.make<Spheres>(law, scene.soil_depths());
  double const preparation = preparing.seconds();
  scarp::SerialExecutor executor;
  auto problem = scene.problem(executor);
  scarp::CpuTime const running;
  Outside watch;
  auto report = scene.settle(problem, watch);
  if (report.verdict.acceptable()) report = scarp::joined(report, scene.rupture(problem, watch));
  if (!report.verdict.acceptable()) scarp::reject("the run ended early ({})", name(report.verdict.reason));
  double const cpu = running.seconds();
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  double const share = watch.in_points / watch.seconds;
  fmt::print(
      R"({{"elements": {}, "points": {}, "grains": {}, "steps": {}, "iterations": {}, "dem_steps": {}, "preparation": {}, )"
      R"("in_points": {}, "outside": {}, "peak_memory_bytes": {}}})"
      "\n",
      problem.discretisation().mesh().elements.size(), problem.discretisation().point_count(), grains, report.steps,
      report.iterations, report.inner_steps, preparation, cpu * share, cpu * (1.0 - share),
      1024.0 * static_cast<double>(used.ru_maxrss));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) scarp::reject("{} arguments were given (two are expected): in_space ELEMENTS GRAINS", argc - 1);
    measure(std::atoi(argv[1]), std::atoi(argv[2]));
  } catch (std::exception const& problem) {
    fmt::print(stderr, "in_space: {}\n", problem.what());
    return 1;
  }
}

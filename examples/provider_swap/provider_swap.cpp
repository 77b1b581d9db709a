// SPDX-License-Identifier: BSL-1.0
// What changes when every element's elastic law is replaced by a packing of grains? In the program: one template
// argument.
#include "../shared/print.hpp"
#include "../shared/version_option.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/fault/rupture_survey.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/level_ground.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/solver/thread_executor.hpp"

using Elastic = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Sand = scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>>;

template <class Soil>
bool rupture(char const* name, scarp::FreeFieldFault<Soil> const& scene) {
  scarp::ThreadExecutor executor;
  scarp::NoObserver no_observer;
  auto problem = scene.problem(executor);
  bool balanced = scene.settle(problem, no_observer).verdict.acceptable();
  double k0 = 0.0;
  for (auto const& stress : problem.committed_stresses()) k0 += stress(0) / stress(1);
  auto const rest = ground_at_rest(problem);
  auto const run = scene.rupture(problem, no_observer);
  auto const& mesh = problem.discretisation().mesh();
  auto const offset = offset_at(scene.fault, run.load);
  auto const found = rupture_survey(mesh, rest.of(mesh.nodes), problem.discretisation().positions(), offset).surface;
  examples::print(stdout,
                  "{:<8} K0 {:.3f}  throw {:.3f} m  outcrop_x {:6.2f} m  steepest_x {:6.2f} m  surface_x50 {:6.2f} m\n",
                  name, k0 / problem.points().size(), run.load, found.outcrop_x, found.steepest_x, found.surface_x50);
  return balanced && run.verdict.acceptable();
}

int main(int argc, char** argv) {
  if (auto const code = examples::ended_without_options(argc, argv, "One scene, first elastic, then of packings"))
    return *code;
  scarp::FaultMesh const layer{.size = 5.0};
  auto const elastic = Elastic::from_young_poisson(20e6, 0.3, {.surcharge = 4e3, .unit_weight = 15.68e3, .k0 = 0.4});
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  scarp::LevelGround<scarp::EllipseGrading> const ground{{{4e-3, 6e-3, 0.75}, 100, 2650.0, 0.2}};
  std::vector<double> depths;  // three levels of points in each row of crossed triangles
  for (double depth = 5.0 / 6.0; depth < layer.depth; depth += 5.0 / 3.0) depths.push_back(depth);
  Sand const sand{.law = law, .source = ground.make<Grains>(law, depths), .pressure_floor = 1e3};
  bool const done = rupture<Elastic>("elastic", {.soil = elastic, .ground = {layer}, .throw_to = 0.25});
  return rupture<Sand>("grains", {.soil = sand, .ground = {layer}, .throw_to = 0.25}) && done ? 0 : 1;
}

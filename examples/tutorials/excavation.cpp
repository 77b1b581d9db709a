// SPDX-License-Identifier: BSL-1.0
// User-defined boundary-value problem: a trench is cut into sand of packings on elastic rock, on a mesh from Gmsh.
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/level_ground.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/solver/analysis.hpp"

int main(int count, char** arguments) try {
  auto const own = std::filesystem::path(__FILE__).replace_filename("excavation.msh");
  scarp::Model model(scarp::read_gmsh<scarp::Tri6>(count > 1 ? arguments[1] : own));
  model.fix({"left", "right"}, 0);  // rollers
  model.fix({"bottom"}, 1);
  model.gravity(16e3);                                  // [N/m3]
  model.surcharge({"surface", "slope", "floor"}, 4e3);  // [Pa]
  auto const at_rest = model.geostatic(0.5);
  model.material("rock", scarp::LinearElastic<2, scarp::GeostaticStress<2>>::from_young_poisson(500e6, 0.25, at_rest));
  // For every depth of the sand a packing that was compressed to the overburden; springs in N/m.
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  scarp::LevelGround<scarp::EllipseGrading> ground{.unit_weight = at_rest.unit_weight, .surcharge = at_rest.surcharge};
  ground.cloud = {.grading = {4e-3, 6e-3, 0.6}, .grains = 200, .density = 2650.0, .thickness = 0.2};
  scarp::DemRve sand{law, ground.make<scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>>(law, model.depths())};
  sand.pressure_floor = at_rest.surcharge / 2.0;
  model.material("sand", scarp::StiffnessFloor{sand});
  scarp::Analysis analysis(model, {.solver = {.tolerance = 2e-3, .max_iterations = 40}});
  scarp::FieldSeries series("output/excavation", {.to = 1.0, .count = 4});
  fmt::print("excavated  heave of the floor [mm]  base reaction [kN/m]  steps  iterations\n");
  for (int stage = 1; stage <= 4; ++stage) {
    auto const run = analysis.to(0.25 * stage, series);
    fmt::print("{:9.2f} {:24.2f} {:21.1f} {:6} {:11}\n", run.load, 1e3 * analysis.displacement("floor", 1),
               1e-3 * analysis.reaction("bottom").y(), run.steps, run.iterations);
    if (!run.verdict.acceptable()) throw std::runtime_error(analysis.why(run));
  }
  double const share = analysis.reaction("bottom").y() / -model.dead_loads().sum();
  fmt::print("base reaction over weight and surcharge: {:.5f}\n", share);  // it carries what is left above it
  if (std::abs(share - 1.0) > 2e-3) throw std::runtime_error("the base does not carry it: reduce the tolerance");
} catch (std::exception const& problem) {
  return fmt::print(stderr, "excavation: {}\n", problem.what()), 2;
}

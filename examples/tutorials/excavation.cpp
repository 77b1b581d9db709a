// SPDX-License-Identifier: BSL-1.0
// User-defined boundary-value problem: a trench is cut into sand of packings on elastic rock, on a mesh from Gmsh.
#include <fmt/core.h>

#include <filesystem>

#include "scarp/bvp/default_integration.hpp"
#include "scarp/bvp/loads.hpp"
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
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/make_problem.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "scarp/solver/thread_executor.hpp"

using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Sand = scarp::StiffnessFloor<scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>>>;
using Grid = scarp::DefaultGrid<scarp::Tri6>;

/// Vertical force [N] of the support of a side whose nodes carry these loads [N], per metre of thickness.
template <class Problem>
double reaction(Problem const& problem, std::string_view side, Eigen::VectorXd const& loads) {
  auto const& grid = problem.discretisation();
  Eigen::VectorXd forces;
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), problem.committed_stresses(), forces);
  double sum = 0.0;
  for (int const node : boundary_nodes(grid.mesh(), side)) sum += forces(2 * node + 1) - loads(2 * node + 1);
  return sum;
}

int main(int count, char** arguments) try {
  auto const file = count > 1 ? std::filesystem::path(arguments[1])
                              : std::filesystem::path(__FILE__).replace_filename("excavation.msh");
  double const unit_weight = 16e3, cover = 4e3;  // [N/m3], [Pa]
  Grid grid(scarp::read_gmsh<scarp::Tri6>(file));
  double const level = grid.mesh().nodes[static_cast<std::size_t>(boundary_nodes(grid.mesh(), "surface").front())].y();
  // Materials: elastic rock, and for every depth of the sand a packing that was compressed to the overburden.
  auto const rock = scarp::LinearElastic<2, scarp::GeostaticStress<2>>::from_young_poisson(
      500e6, 0.25, {.surcharge = cover, .unit_weight = unit_weight, .k0 = 0.5});
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};  // [N/m]
  scarp::LevelGround<scarp::EllipseGrading> const column{
      .cloud = {.grading = {4e-3, 6e-3, 0.6}, .grains = 200, .density = 2650.0, .thickness = 0.2},
      .unit_weight = unit_weight,
      .surcharge = cover};
  std::vector<double> depths;
  for (int point = 0; point < grid.point_count(); ++point) depths.push_back(grid.site(point, level).depth);
  Sand const sand{.provider = {.law = law, .source = column.make<Grains>(law, depths), .pressure_floor = cover / 2.0}};
  auto const regions = boost::hana::make_tuple(scarp::Region{"sand", sand}, scarp::Region{"rock", rock});
  // Boundary conditions by the names of groups: rollers.
  scarp::Constraints constraints(grid.mesh());
  for (auto const* const side : {"left", "right"})
    for (int const node : boundary_nodes(grid.mesh(), side)) constraints.fix(node, 0);
  for (int const node : boundary_nodes(grid.mesh(), "bottom")) constraints.fix(node, 1);
  // Loads: the forces that hold the ground as it was, which fade, and those that act on it in the end, which grow.
  scarp::ThreadExecutor executor;
  auto points = make_points(grid, level, regions, executor);
  Eigen::VectorXd before;
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), points.committed_stresses(executor), before);
  Eigen::VectorXd after = body_force(grid, [&](int) { return scarp::Vector<2>(0.0, -unit_weight); });
  for (auto const* const part : {"surface", "slope", "floor"})
    after += traction(grid, part, scarp::Vector<2>(0.0, -cover));
  scarp::LoadHistory loads;
  loads.add(before, scarp::TimeFunction({{0.0, 1.0}, {1.0, 0.0}}));
  loads.add(after, scarp::TimeFunction::ramp(0.0, 1.0));

  using Problem = scarp::EquilibriumProblem<Grid, scarp::ThreadExecutor>;
  Problem problem{std::move(grid), std::move(points), std::move(constraints), std::move(loads), executor};
  scarp::QuasiNewton<> const solver{.tolerance = 2e-3, .max_iterations = 40};
  scarp::QuasiNewton<>::Session<Problem> session(solver, problem);
  scarp::LoadStepping const stepping{.first = 0.05, .smallest = 1e-4, .largest = 0.1};
  std::filesystem::create_directories("output/excavation/fields");
  scarp::FieldSeries series("output/excavation", 1.0, 4, 1.0);  // to load 1, 4 files
  fmt::print("excavated  heave of the floor [mm]  base reaction [kN/m]  steps  iterations\n");
  scarp::RunReport run;
  for (int stage = 1; stage <= 4 && run.verdict.acceptable(); ++stage) {
    run = stepping.advance(session, problem, 0.25 * (stage - 1), 0.25 * stage, series);
    auto const& now = problem.discretisation();
    double heave = 0.0;
    for (int const node : boundary_nodes(now.mesh(), "floor")) {
      auto const k = static_cast<std::size_t>(node);
      heave = std::max(heave, now.positions()[k].y() - now.mesh().nodes[k].y());
    }
    fmt::print("{:9.2f} {:24.2f} {:21.1f} {:6} {:11}\n", run.load, 1e3 * heave,
               1e-3 * reaction(problem, "bottom", after), run.steps, run.iterations);
  }
  if (!run.verdict.acceptable()) {
    fmt::print(stderr, "excavation: stopped at load {:.3f} ({}): take smaller load steps\n", run.load,
               name(run.verdict.reason));
    return 1;
  }
  double const share = reaction(problem, "bottom", after) / -after.sum();  // the base carries what is left above it
  fmt::print("base reaction over weight and surcharge: {:.5f}\n", share);
  if (std::abs(share - 1.0) < solver.tolerance) return 0;
  fmt::print(stderr, "excavation: the base does not carry what is above it (1 is expected): reduce the tolerance\n");
  return 1;
} catch (std::exception const& problem) {
  fmt::print(stderr, "excavation: {}\n", problem.what());
  return 2;
}

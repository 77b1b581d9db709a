// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/stiffness_floor.hpp"

#include <doctest/doctest.h>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/observe/totals.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using Elastic = scarp::LinearElastic<2>;
using Grid = scarp::Discretisation<scarp::Quad4>;

Elastic ground() { return Elastic::from_young_poisson(20e6, 0.3); }

/// Elastic ground that loses all contacts above a height once it is strained, as a packing does in tension.
struct Fluidised {
  static constexpr int dim = 2;
  static constexpr bool exact_tangent = true;
  struct State {
    bool loose = false;
    bool fluid = false;
    Elastic::State own;
  };

  double height = 1.0;       ///< [m]
  bool fluid_start = false;  ///< whether it has no contacts there from the start

  State initial_state(scarp::Site<2> const& site) const {
    bool const loose = site.position.y() > height;
    return {loose, loose && fluid_start, {}};
  }
  scarp::VoigtStress<2> stress(State const& state) const { return state.own.stress; }
  scarp::VoigtTangent<2> tangent(State const& state) const { return (state.fluid ? 0.0 : 1.0) * ground().tangent({}); }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    trial = committed;
    trial.fluid = committed.loose;
    if (trial.fluid) return {scarp::VoigtStress<2>::Zero(), {scarp::Status::fluid, scarp::Reason::no_contacts}};
    return ground().respond(committed.own, increment, trial.own);
  }
};

using Floor = scarp::StiffnessFloor<Fluidised>;
using Problem = scarp::EquilibriumProblem<Grid>;

/// A column of four elements between smooth walls, whose foot moves up by the load factor [m]; its upper half is loose.
template <class Soil>
Problem column(Soil const& soil, scarp::SerialExecutor& executor) {
  Grid grid(scarp::BoxMesh<scarp::Quad4>{.lengths = {1.0, 2.0}, .cells = {1, 4}}.generate());
  scarp::Constraints constraints(grid.mesh());
  for (auto const* wall : {"left", "right"}) {
    for (int const node : scarp::boundary_nodes(grid.mesh(), wall)) constraints.fix(node, 0);
  }
  for (int const node : scarp::boundary_nodes(grid.mesh(), "bottom")) constraints.move(node, 1, 1.0);
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 2.0));
  // A pull at the middle level, so that there is stress to compare with.
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(grid.dof_count());
  for (std::size_t n = 0; n < grid.mesh().nodes.size(); ++n) {
    if (grid.mesh().nodes[n].y() == 1.0) loads(static_cast<Eigen::Index>(2 * n + 1)) = -10e3;
  }
  scarp::LoadHistory history(Eigen::VectorXd::Zero(grid.dof_count()));
  history.add(loads, scarp::TimeFunction::ramp(0.0, 1.0));
  return {std::move(grid), {soil, sites}, std::move(constraints), history, executor};
}

scarp::RunReport load(Problem& problem, double to) {
  scarp::NoObserver no_observer;
  scarp::QuasiNewton<> const solver{.tolerance = 1e-9};
  return scarp::LoadStepping{.first = 0.5 * to, .max_displacement_gradient = 1.0}.run(solver, problem, 0.0, to,
                                                                                      no_observer);
}

}  // namespace

TEST_CASE("nodes with nothing but fluid points around them are held by the floor, and its share of force is told") {
  scarp::SerialExecutor executor;
  // A floor too low for the digits of a double is none: the second step begins from fluid points.
  auto without = column(Floor{.share = 1e-30}, executor);
  auto const singular = load(without, 1e-3);
  CHECK_FALSE(singular.verdict.acceptable());
  CHECK(singular.verdict.reason == scarp::Reason::singular_system);
  auto problem = column(Floor{}, executor);
  auto const run = load(problem, 1e-3);
  CHECK(run.verdict.acceptable());
  CHECK(run.load == 1e-3);
  int fluid = 0;
  for (int point = 0; point < 16; ++point) fluid += problem.points().state<Floor::State>(point).fluid ? 1 : 0;
  CHECK(fluid == 8);
  // The free top follows the middle: the floor has next to nothing to hold.
  CHECK(scarp::floor_share(problem) < 1e-3);
  double floors = 0.0;
  double all = 0.0;
  for (int point = 0; point < 16; ++point) {  // of equal volumes, to the strain of 1e-3
    floors += problem.points().floor_stress(point).norm();
    all += problem.points().committed_stress(point).norm();
  }
  REQUIRE(floors > 0.0);
  CHECK(scarp::floor_share(problem) == samples::Approx(floors / all).epsilon(1e-2));
}

TEST_CASE("points that are fluid from the start have the floor at once") {
  Floor const floor{.provider = {.fluid_start = true}, .shear_modulus = 3e3};
  auto const loose = floor.initial_state({.position = {0.0, 2.0}});
  CHECK(loose.fluid);
  // Analytic: without Poisson's ratio the stiffness is twice the shear modulus along the axes.
  scarp::VoigtTangent<2> const expected = scarp::Vector<3>(6e3, 6e3, 3e3).asDiagonal();
  CHECK((floor.tangent(loose) - expected).norm() <= 1e-12 * expected.norm());
  CHECK(floor.stress(loose).isZero(0.0));
  auto const solid = floor.initial_state({.position = {0.0, 0.5}});
  CHECK_FALSE(solid.fluid);
  CHECK(floor.tangent(solid) == ground().tangent({}));
  CHECK_REFUSED((Floor{.provider = {.fluid_start = true}}).initial_state({.position = {0.0, 2.0}}), "fluid", "modulus");

  scarp::SerialExecutor executor;
  Fluidised const all_fluid{.height = 0.0, .fluid_start = true};
  auto problem = column(Floor{.provider = all_fluid, .shear_modulus = 1e6}, executor);
  CHECK(load(problem, 1e-3).verdict.acceptable());
  // Without a stiffness anywhere each free node is as weak as the others: some node is named.
  auto without = column(all_fluid, executor);
  auto const stopped = load(without, 1e-3);
  CHECK(stopped.verdict.reason == scarp::Reason::singular_system);
  CHECK(stopped.weak_dof >= 0);
}

TEST_CASE("a fluid point strained on its own carries the floor's stress, a solid one the provider's bits") {
  Floor const floor{.provider = {}, .share = 1e-3};
  scarp::Gradient<2> const increment{{1e-3, 2e-3}, {-1e-3, -5e-4}};
  auto const loose = floor.initial_state({.position = {0.0, 2.0}});
  auto trial = loose;
  auto const answer = floor.respond(loose, increment, trial);
  CHECK(answer.verdict.status == scarp::Status::fluid);
  // Analytic: the thousandth part of isotropic elasticity is its own isotropic part.
  auto const thousandth = Elastic::from_young_poisson(20e3, 0.3);
  Elastic::State expected{};
  CHECK((answer.stress - thousandth.respond({}, increment, expected).stress).norm() <= 1e-12 * answer.stress.norm());
  CHECK((floor.tangent(trial) - thousandth.tangent({})).norm() <= 1e-12 * floor.tangent(trial).norm());
  CHECK(floor.stress(trial) == answer.stress);

  auto const solid = floor.initial_state({.position = {0.0, 0.5}});
  auto moved = solid;
  Elastic::State bare{};
  CHECK(floor.respond(solid, increment, moved).stress == ground().respond({}, increment, bare).stress);
  CHECK(floor.tangent(moved) == ground().tangent({}));
  CHECK_REFUSED((Floor{.provider = {}, .share = 0.0}).initial_state({}), "share", "is 0");
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/equilibrium_problem.hpp"

#include <doctest/doctest.h>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/following_pressure.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/crossed_rectangle.hpp"
#include "support/refusals.hpp"

namespace {

using Soil = scarp::LinearElastic<2>;
using Grid = scarp::Discretisation<scarp::Tri3, scarp::SmallStrain>;
using Problem = scarp::EquilibriumProblem<Grid>;
using Newton = scarp::QuasiNewton<>;

constexpr double pressure = 1e4;  // [Pa]

Soil soil() { return Soil::from_young_poisson(20e6, 0.3); }

Grid square() { return Grid(samples::CrossedRectangle{.columns = 3, .rows = 3}.generate()); }

scarp::MaterialPoints<2> points_on(Grid const& grid) {
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  return {soil(), sites};
}

/// Three degrees of freedom: no more than a rigid body has.
scarp::Constraints held_as_a_body(Grid const& grid) {
  scarp::Constraints constraints(grid.mesh());
  auto const& nodes = grid.mesh().nodes;
  for (int node = 0; node < grid.node_count(); ++node) {
    auto const& place = nodes[static_cast<std::size_t>(node)];
    if (place.isZero(0.0)) constraints.fix(node);
    if (place == scarp::Vector<2>(1.0, 0.0)) constraints.fix(node, 1);
  }
  REQUIRE(constraints.prescribed_dofs().size() == 3);
  return constraints;
}

Eigen::VectorXd on_all_sides(Grid const& grid) {
  return grid.traction("left", {pressure, 0.0}) + grid.traction("right", {-pressure, 0.0}) +
         grid.traction("bottom", {0.0, pressure}) + grid.traction("top", {0.0, -pressure});
}

template <class Problem>
void is_pressed(Problem const& problem) {
  for (auto const& stress : problem.committed_stresses()) {
    // Analytic: a uniform stress. The logarithm of the strain of 2e-4 departs from its size by 1e-4 of it.
    CHECK((stress - scarp::VoigtStress<2>(-pressure, -pressure, 0.0)).norm() < 1e-3 * pressure);
  }
}

}  // namespace

TEST_CASE("a body that is pressed from all sides by dead loads, with reactions of round-off, converges") {
  scarp::SerialExecutor serial;
  auto grid = square();
  auto const loads = on_all_sides(grid);
  auto constraints = held_as_a_body(grid);
  auto points = points_on(grid);
  Problem problem(std::move(grid), std::move(points), std::move(constraints), loads, serial);
  scarp::NoObserver no_observer;
  auto const run = scarp::LoadStepping{}.settle(Newton{.tolerance = 1e-3}, problem, 0.0, no_observer);
  CHECK(run.verdict == scarp::Verdict{});
  CHECK(run.iterations <= 3);
  is_pressed(problem);
}

TEST_CASE("a body that a fluid presses from all sides converges, though there are neither loads nor reactions") {
  scarp::SerialExecutor serial;
  auto grid = square();
  std::vector<scarp::FollowingPressure<>::Facet> facets;
  for (auto const* side : {"left", "right", "bottom", "top"}) {
    auto const& of_side = scarp::boundary(grid.mesh(), side);
    facets.insert(facets.end(), of_side.begin(), of_side.end());
  }
  auto constraints = held_as_a_body(grid);
  auto points = points_on(grid);
  Problem problem(std::move(grid), std::move(points), std::move(constraints), {}, serial,
                  scarp::FollowingPressure<>(facets, pressure));
  scarp::NoObserver no_observer;
  auto const run = scarp::LoadStepping{}.settle(Newton{.tolerance = 1e-3}, problem, 0.0, no_observer);
  CHECK(run.verdict == scarp::Verdict{});
  CHECK(run.iterations <= 3);
  is_pressed(problem);
}

TEST_CASE_TEMPLATE("a law is tested on one element all of whose nodes are moved", Solver, scarp::QuasiNewton<>,
                   Newton) {
  scarp::SerialExecutor serial;
  Grid grid(samples::CrossedRectangle{.columns = 1, .rows = 1}.generate());
  scarp::Constraints constraints(grid.mesh());
  for (int node = 0; node < grid.node_count(); ++node) {
    constraints.fix(node, 0);
    constraints.move(node, 1, -grid.mesh().nodes[static_cast<std::size_t>(node)].y());
  }
  REQUIRE(constraints.free_count() == 0);
  auto points = points_on(grid);
  Problem problem(std::move(grid), std::move(points), std::move(constraints), {}, serial);
  scarp::NoObserver no_observer;
  auto const run = scarp::LoadStepping{}.run(Solver{}, problem, 0.0, 1e-4, no_observer);
  CHECK(run.verdict == scarp::Verdict{});
  CHECK(run.load == 1e-4);
  // Analytic: uniaxial compression, to the strain's square.
  double const modulus = soil().elasticity.lame_lambda + 2.0 * soil().elasticity.shear_modulus;
  for (auto const& stress : problem.committed_stresses())
    CHECK(std::abs(stress(1) + 1e-4 * modulus) < 2e-4 * 1e-4 * modulus);
}

TEST_CASE("only the increment that was evaluated is refined and committed, and a refused commit changes nothing") {
  scarp::SerialExecutor serial;
  auto grid = square();
  auto constraints = held_as_a_body(grid);
  auto points = points_on(grid);
  Problem problem(std::move(grid), std::move(points), std::move(constraints), {}, serial);
  auto const before = problem.discretisation().positions();
  Eigen::VectorXd const increment = Eigen::VectorXd::Constant(problem.dof_count(), 1e-4);
  REQUIRE(problem.evaluate(increment).verdict.acceptable());
  CHECK(problem.refine(increment).verdict.acceptable());
  CHECK_REFUSED(problem.refine(2.0 * increment), "to be refined", "evaluated last");
  CHECK_REFUSED(problem.commit(2.0 * increment), "to be committed", "evaluated last");
  problem.points().commit();  // past the problem, which has no trial states then
  CHECK_REFUSED(problem.commit(increment), "without a response");
  CHECK(problem.discretisation().positions() == before);
}

TEST_CASE("parts that do not fit together are refused") {
  scarp::SerialExecutor serial;
  auto const grid = square();
  auto const constraints = held_as_a_body(grid);
  Grid const smaller(samples::CrossedRectangle{}.generate());
  auto const make = [&](scarp::MaterialPoints<2> points, scarp::Constraints const& held, scarp::LoadHistory loads) {
    Problem const problem(grid, std::move(points), held, std::move(loads), serial);
  };
  CHECK_REFUSED(make(points_on(smaller), constraints, {}), fmt::format("for {} points", smaller.point_count()),
                fmt::format("the mesh has {}", grid.point_count()));
  CHECK_REFUSED(make(points_on(grid), constraints, {Eigen::VectorXd::Zero(7)}), "loads have 7 entries",
                fmt::format("{} degrees of freedom", grid.dof_count()));
  CHECK_REFUSED(make(points_on(grid), scarp::Constraints(smaller.mesh()), {}),
                fmt::format("constraints {}", smaller.dof_count()));
}

TEST_CASE("an increment is committed once, after its own evaluation") {
  scarp::SerialExecutor serial;
  auto grid = square();
  auto constraints = held_as_a_body(grid);
  auto points = points_on(grid);
  Problem problem(std::move(grid), std::move(points), std::move(constraints), {}, serial);
  Eigen::VectorXd const first = Eigen::VectorXd::LinSpaced(problem.dof_count(), 0.0, 1e-4);
  CHECK_REFUSED(problem.commit(first), "increment", "evaluate");
  REQUIRE(problem.evaluate(first).verdict.acceptable());
  CHECK_REFUSED(problem.commit(2.0 * first), "increment", "evaluate");
  static_cast<void>(problem.plan(2.0 * first));
  CHECK_REFUSED(problem.commit(first), "increment", "evaluate");
  REQUIRE(problem.evaluate(first).verdict.acceptable());
  static_cast<void>(problem.evaluate_committed());
  CHECK_REFUSED(problem.commit(first), "increment", "evaluate");
  REQUIRE(problem.evaluate(first).verdict.acceptable());
  problem.commit(first);
  auto const stresses = problem.committed_stresses();
  CHECK_REFUSED(problem.commit(first), "increment", "evaluate");
  CHECK(problem.committed_stresses() == stresses);
}

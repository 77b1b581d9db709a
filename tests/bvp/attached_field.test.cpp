// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/attached_field.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "bvp/sample_problems.hpp"
#include "scarp/bvp/default_grid.hpp"
#include "scarp/bvp/following_pressure.hpp"
#include "scarp/bvp/pore_water.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/make_problem.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Approx;
using scarp::Quad8;
using scarp::TimeFunction;
using scarp::Vector;
using Grid = scarp::DefaultGrid<Quad8>;
using Lateral = scarp::FollowingPressure<Quad8::Facet>;
using Water = scarp::PoreWater<Grid, scarp::ConstantPermeability>;

constexpr double young = 1e7, poisson = 0.25, shear = young / 2.5;
constexpr double width = 0.5, height = 1.0, thickness = 0.2;  // [m]
constexpr double pressure = 10.0;                             // [Pa], a strain of 1e-6

Grid column_grid() {
  return Grid(scarp::BoxMesh<Quad8>{.lengths = Vector<2>(width, height), .cells = {2, 4}}.generate(), thickness);
}

/// Undrained up to the load factor 1, consolidated to a part from there to 2.
Water water_in(Grid const& grid) {
  Water water(grid, {.conductivity = 1e-7},
              {.shear_modulus = shear, .clock = TimeFunction({{0.0, 0.0}, {1.0, 0.0}, {2.0, 1.0}})});
  water.drain({"bottom"});
  return water;
}

Lateral pressure_on(Grid const& grid, char const* side) {
  return {scarp::boundary(grid.mesh(), side), pressure, thickness};
}

/// A column between smooth walls on a drained base, with what is attached to it.
struct Column {
  Grid grid;
  scarp::SerialExecutor serial{};
  scarp::EquilibriumProblem<Grid> problem;

  /// load [Pa]: a dead one on the top
  template <class... Attached>
  Column(Grid of, int extra_dofs, double load, Attached const&... attached)
      : grid(std::move(of)), problem(made(grid, serial, extra_dofs, load, attached...)) {}

  void run(double from, double to) {
    scarp::LoadStepping const stepping{
        .first = 0.1, .smallest = 1e-6, .largest = 0.1, .max_displacement_gradient = 1.0};
    scarp::NoObserver nobody;
    REQUIRE(stepping.run(scarp::QuasiNewton<>{.tolerance = 1e-9}, problem, from, to, nobody).verdict.acceptable());
  }
  double settlement() const { return grid.nodes()[top()].y() - problem.grid().positions()[top()].y(); }

 private:
  std::size_t top() const { return static_cast<std::size_t>(grid.boundary_nodes("top").front()); }

  template <class... Attached>
  static scarp::EquilibriumProblem<Grid> made(Grid const& grid, scarp::SerialExecutor& serial, int extra_dofs,
                                              double load, Attached const&... attached) {
    scarp::Constraints constraints(grid, extra_dofs);
    for (auto const* wall : {"left", "right"})
      for (int const node : grid.boundary_nodes(wall)) constraints.fix(node, 0);
    for (int const node : grid.boundary_nodes("bottom")) constraints.fix(node, 1);
    scarp::LoadHistory loads(grid.traction("top", {0.0, -load}));
    loads.add_dofs(extra_dofs);
    scarp::Region const soil{"soil", scarp::LinearElastic<2>::from_young_poisson(young, poisson)};
    return make_problem(grid, height, boost::hana::make_tuple(soil), constraints, loads, serial, attached...);
  }
};

/// A body of three degrees of freedom that nothing loads, each on a spring of 1 N/m, and which remembers where it was
/// asked to be.
struct Body {
  int first = 0;                       ///< of its degrees of freedom
  std::vector<double> place{0, 0, 0};  ///< [m], committed

  static int extra_dofs() { return 3; }
  scarp::Verdict add_forces(std::vector<Vector<2>> const&, Eigen::VectorXd const& increment,
                            Eigen::VectorXd& forces) const {
    for (int k = 0; k < 3; ++k) forces(first + k) += place[static_cast<std::size_t>(k)] + increment(first + k);
    return {};
  }
  void add_stiffness(std::vector<Eigen::Triplet<double>>& entries) const {
    for (int k = 0; k < 3; ++k) entries.emplace_back(first + k, first + k, 1.0);
  }
  void commit(std::vector<Vector<2>> const&, Eigen::VectorXd const& increment) {
    for (int k = 0; k < 3; ++k) place[static_cast<std::size_t>(k)] += increment(first + k);
  }
  SCARP_MEMBERS_EXCEPT((first), place)
};

}  // namespace

TEST_CASE("a saturated column consolidates below a pressure that follows as below a traction, at small strain") {
  auto const grid = column_grid();
  auto const water = water_in(grid);
  Column followed(grid, water.extra_dofs(), 0.0, pressure_on(grid, "top"), water);
  Column loaded(grid, water.extra_dofs(), pressure, water);
  double before = 0.0;
  for (double const load : {1.0, 1.3, 2.0}) {
    followed.run(before, load);
    loaded.run(before, load);
    before = load;
    auto const& wet = followed.problem.attached<Water>();
    auto const& alone = loaded.problem.attached<Water>();
    CHECK(wet.time() == alone.time());
    for (std::size_t node = 0; node < grid.nodes().size(); ++node)  // strains of 1e-6
      CHECK(std::abs(wet.pressures()[node] - alone.pressures()[node]) < 1e-5 * pressure);
    CHECK(followed.settlement() == Approx(loaded.settlement()).epsilon(1e-5));
  }
  double const drained = pressure * height / (shear * 2.0 * (1.0 - poisson) / (1.0 - 2.0 * poisson));
  CHECK(followed.settlement() > 0.1 * drained);  // something has drained
  CHECK(followed.settlement() < 0.9 * drained);  // not everything
}

TEST_CASE("a body beside a field has the degrees of freedom before the field's, and neither disturbs the other") {
  auto const grid = column_grid();
  auto const water = water_in(grid);
  Body const body{.first = grid.dof_count(), .place = {1e-3, 0.0, -2e-3}};
  Column both(grid, body.extra_dofs() + water.extra_dofs(), pressure, water, body);
  Column alone(grid, water.extra_dofs(), pressure, water);
  REQUIRE(both.problem.first_beside() == grid.dof_count());
  REQUIRE(both.problem.first_of_field() == grid.dof_count() + 3);
  CHECK(both.problem.describe_dof(grid.dof_count() + 1) == "extra degree of freedom 1");
  CHECK(both.problem.describe_dof(grid.dof_count() + 3) == water.describe(0));
  both.run(0.0, 2.0);
  alone.run(0.0, 2.0);
  for (std::size_t node = 0; node < grid.nodes().size(); ++node)
    CHECK(both.problem.attached<Water>().pressures()[node] ==
          Approx(alone.problem.attached<Water>().pressures()[node]).epsilon(1e-9));
  for (double const place : both.problem.attached<Body>().place) CHECK(std::abs(place) < 1e-12);  // springs relaxed
  auto const parts = both.problem.residuals(both.problem.evaluate_committed().unbalanced);
  REQUIRE(parts.size() == 3);
  CHECK(parts[1].name == "attached");
  CHECK(parts[2].name == "water");
}

TEST_CASE("the stiffness of a field behind a body is the derivative of its forces") {
  Grid const grid(samples::distorted_block<Quad8>(2), thickness);
  Water water = water_in(grid);
  int const body = 3;
  int const size = grid.dof_count() + body + water.extra_dofs();
  water.at(1.5);
  auto const forces_at = [&](Eigen::VectorXd const& increment) {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(size);
    REQUIRE(water.add_forces(grid.positions(), increment, forces).acceptable());
    return forces;
  };
  Eigen::VectorXd const at = samples::random_increment(size, 0.02, 7);
  Eigen::VectorXd const way = samples::random_increment(size, 1.0, 8);
  constexpr double step = 1e-6;
  Eigen::VectorXd const change = (forces_at(at + step * way) - forces_at(at - step * way)) / (2.0 * step);
  auto const forces = forces_at(at);
  CHECK(forces.segment(grid.dof_count(), body).norm() == 0.0);
  std::vector<Eigen::Triplet<double>> entries;
  water.add_stiffness(entries);
  Eigen::VectorXd product = Eigen::VectorXd::Zero(size);
  for (auto const& entry : entries) product(entry.row()) += entry.value() * way(entry.col());
  CHECK((product - change).norm() < 1e-7 * change.norm());
}

TEST_CASE("a column below a pressure that follows goes on with the same bits once it was saved") {
  auto const grid = column_grid();
  auto const water = water_in(grid);
  Column whole(grid, water.extra_dofs(), 0.0, water, pressure_on(grid, "top"));
  Column resumed(grid, water.extra_dofs(), 0.0, water, pressure_on(grid, "top"));
  whole.run(0.0, 1.4);
  scarp::StateWriter writer;
  writer("problem", whole.problem);
  scarp::StateReader reader(writer.bits());
  reader("problem", resumed.problem);
  CHECK(reader.at_end());
  scarp::StateWriter first;
  scarp::StateWriter second;
  for (auto* column : {&whole, &resumed}) column->run(1.4, 2.0);
  first("problem", whole.problem);
  second("problem", resumed.problem);
  CHECK(first.bits() == second.bits());
}

TEST_CASE("a mesh has one field and one body or load, which fit it") {
  auto const grid = column_grid();
  auto const water = water_in(grid);
  auto const load = pressure_on(grid, "top");
  int const extra = water.extra_dofs();
  CHECK_REFUSED(Column(grid, extra, 0.0, water, water), "second field");
  CHECK_REFUSED(Column(grid, extra, 0.0, load, load, water), "second body or load");
  CHECK_REFUSED(Column(grid, extra, 0.0, Lateral(scarp::boundary(grid.mesh(), "top"), pressure, 1.0), water),
                "1 m thick", "0.2 m");
  Column dry(grid, 0, 0.0, load);
  CHECK_REFUSED(dry.problem.attached<Water>(), "another type");
}

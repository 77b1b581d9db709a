// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/field_with_load.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "bvp/sample_problems.hpp"
#include "scarp/bvp/following_pressure.hpp"
#include "scarp/bvp/pore_water.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/solver/analysis.hpp"
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
using Both = scarp::FieldWithLoad<Lateral, Water>;

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

/// Between smooth walls, or free on the right.
template <class Attached>
scarp::Model<2> column(Grid const& grid, Attached const& attached, bool walls = true) {
  scarp::Model model(grid);
  model.fix({"left"}, 0);
  if (walls) model.fix({"right"}, 0);
  model.fix({"bottom"}, 1);
  model.material("soil", scarp::LinearElastic<2>::from_young_poisson(young, poisson));
  model.attach(attached);
  return model;
}

scarp::AnalysisSettings const settings{
    .stepping = {.first = 1.0, .smallest = 1e-6, .largest = 0.1, .max_displacement_gradient = 1.0}};

/// Forces of an attachment that has not moved yet, on the nodes of the mesh.
Eigen::VectorXd forces_of(Lateral const& load, std::vector<Vector<2>> const& nodes) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(2 * static_cast<int>(nodes.size()));
  REQUIRE(load.add_forces(nodes, Eigen::VectorXd::Zero(sum.size()), sum).acceptable());
  return sum;
}

/// A body beside the ground.
struct Body {
  static int extra_dofs() { return 3; }
  static scarp::Verdict add_forces(std::vector<Vector<2>> const&, Eigen::VectorXd const&, Eigen::VectorXd&) {
    return {};
  }
  static void add_stiffness(std::vector<Eigen::Triplet<double>>&) {}
  static void commit(std::vector<Vector<2>> const&, Eigen::VectorXd const&) {}
};

}  // namespace

TEST_CASE("a saturated column consolidates below a pressure that follows as below a traction, at small strain") {
  auto const grid = column_grid();
  auto followed = column(grid, Both(grid, pressure_on(grid, "top"), water_in(grid)));
  auto loaded = column(grid, water_in(grid));
  loaded.surcharge({"top"}, pressure, TimeFunction::constant(1.0));
  scarp::Analysis first(followed, settings);
  scarp::Analysis second(loaded, settings);
  for (double const factor : {1.0, 1.3, 2.0}) {
    REQUIRE(first.to(factor).verdict.acceptable());
    REQUIRE(second.to(factor).verdict.acceptable());
    auto const& water = first.problem().attached<Both>().field();
    auto const& alone = second.problem().attached<Water>();
    CHECK(water.time() == alone.time());
    for (std::size_t node = 0; node < grid.nodes().size(); ++node)  // strains of 1e-6
      CHECK(std::abs(water.pressures()[node] - alone.pressures()[node]) < 1e-5 * pressure);
    CHECK(first.displacement("top", 1) == Approx(second.displacement("top", 1)).epsilon(1e-5));
    CHECK(first.reaction("bottom").y() == Approx(pressure * width * thickness).epsilon(1e-5));
  }
  double const drained = pressure * height / (shear * 2.0 * (1.0 - poisson) / (1.0 - 2.0 * poisson));
  CHECK(first.displacement("top", 1) < -0.1 * drained);  // something has drained
  CHECK(first.displacement("top", 1) > -0.9 * drained);  // not everything
}

TEST_CASE("forces and stiffness are the sums of those of the load and of the field") {
  Grid const grid(samples::distorted_block<Quad8>(2), thickness);
  auto const load = pressure_on(grid, "right");
  Water water = water_in(grid);
  Both both(grid, load, water);
  REQUIRE(both.extra_dofs() == water.extra_dofs());
  int const size = grid.dof_count() + water.extra_dofs();
  Eigen::VectorXd const increment = samples::random_increment(size, 0.02, 7);
  auto const evaluated = [&](auto& part) {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(size);
    REQUIRE(part.add_forces(grid.positions(), increment, forces).acceptable());
    std::vector<Eigen::Triplet<double>> entries;
    part.add_stiffness(entries);
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
    for (auto const& entry : entries) stiffness(entry.row(), entry.col()) += entry.value();
    return std::pair{forces, stiffness};
  };
  water.at(1.5);
  both.at(1.5);
  auto const [load_forces, load_stiffness] = evaluated(load);
  auto const [water_forces, water_stiffness] = evaluated(water);
  auto const [forces, stiffness] = evaluated(both);
  CHECK(load_forces.norm() > 0.0);
  CHECK(water_forces.norm() > 0.0);
  CHECK((forces - load_forces - water_forces).norm() < 1e-14 * forces.norm());
  CHECK((stiffness - load_stiffness - water_stiffness).norm() < 1e-14 * stiffness.norm());
  CHECK(both.next_knot(0.5) == water.next_knot(0.5));
  CHECK(both.describe(3) == water.describe(3));

  // Committed: the load's force at the moved nodes, and the pressure's.
  CHECK(both.ground_force() == forces_of(load, grid.positions()));
  both.commit(grid.positions(), increment);
  water.commit(grid.positions(), increment);
  auto moved = grid.positions();
  for (std::size_t node = 0; node < moved.size(); ++node)
    moved[node] += increment.segment<2>(2 * static_cast<Eigen::Index>(node));
  CHECK((both.ground_force() - forces_of(load, moved) - water.ground_force()).norm() < 1e-13 * forces.norm());
  CHECK(both.field().time() == water.time());
}

TEST_CASE("a side that a pressure follows needs no reaction") {
  auto const grid = column_grid();
  auto model = column(grid, Both(grid, pressure_on(grid, "right"), water_in(grid)), false);
  scarp::Analysis analysis(model, settings);
  REQUIRE(analysis.to(1.5).verdict.acceptable());
  CHECK(analysis.reaction("left").x() == Approx(pressure * height * thickness).epsilon(1e-5));
  CHECK(std::abs(analysis.reaction("right").x()) < 1e-5 * pressure * height * thickness);
}

TEST_CASE("a column below a pressure that follows goes on with the same bits once it was saved") {
  auto const grid = column_grid();
  auto const model = column(grid, Both(grid, pressure_on(grid, "top"), water_in(grid)));
  scarp::Analysis whole(model, settings);
  scarp::Analysis resumed(model, settings);
  REQUIRE(whole.to(1.4).verdict.acceptable());
  scarp::StateWriter writer;
  writer("analysis", whole);
  scarp::StateReader reader(writer.bits());
  reader("analysis", resumed);
  CHECK(reader.at_end());
  scarp::StateWriter first;
  scarp::StateWriter second;
  for (auto* analysis : {&whole, &resumed}) REQUIRE(analysis->to(2.0).verdict.acceptable());
  first("analysis", whole);
  second("analysis", resumed);
  CHECK(first.bits() == second.bits());
}

TEST_CASE("beside a field stand loads of its mesh alone") {
  auto const grid = column_grid();
  CHECK_REFUSED(scarp::FieldWithLoad(grid, Body{}, water_in(grid)), "3 degrees of freedom of its own");
  CHECK_REFUSED(Both(grid, Lateral(scarp::boundary(grid.mesh(), "top"), pressure, 1.0), water_in(grid)), "1 m thick",
                "0.2 m");
  static_assert(scarp::FieldAttachment<Both> && scarp::Attachment<Both, 2>);
}

// SPDX-License-Identifier: BSL-1.0
// What a program does around pore water: calls that are rejected, stages, steps that are cut, saved states.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "scarp/bvp/pore_water.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/analysis.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Approx;
using scarp::Quad8;
using scarp::TimeFunction;
using Small = scarp::Discretisation<Quad8, scarp::SmallStrain, scarp::ReducedIntegration>;
using Large = scarp::Discretisation<Quad8, scarp::UpdatedLagrangian, scarp::ReducedIntegration>;
template <class Grid>
using WaterOf = scarp::PoreWater<Grid, scarp::ConstantPermeability>;
using Water = WaterOf<Small>;

scarp::Water const incompressible{.bulk_modulus = std::numeric_limits<double>::infinity()};
scarp::AnalysisSettings in_steps(double first) {
  return {.stepping = {.first = first, .smallest = 1e-6, .largest = first, .max_displacement_gradient = 1.0},
          .threads = 1};
}

template <class Grid>
Grid box(int columns, int rows) {
  return Grid(scarp::BoxMesh<Quad8>{.cells = {columns, rows}}.generate());
}

/// Water in stiff ground that stands still, through which it flows for a second.
Water still_water(Small const& grid) {
  return {grid, {.conductivity = 1e-5, .water = incompressible}, {.shear_modulus = 4e9}};
}
template <class Grid>
scarp::Model<2> held(Grid const& grid, WaterOf<Grid> const& water) {
  scarp::Model<2> model(grid);
  model.fix({"left", "right", "bottom", "top"});
  for (auto const& region : grid.regions())
    model.material(region, scarp::LinearElastic<2>::from_young_poisson(1e10, 0.25));
  model.attach(water);
  return model;
}

struct Flow {
  double pressure = 0.0;  ///< largest [Pa]
  double expelled = 0.0;  ///< [m3]
};
Flow after_a_second(Small const& grid, Water const& water) {
  scarp::Analysis analysis(held(grid, water), in_steps(1.0));
  REQUIRE(analysis.to(1.0).verdict.acceptable());
  auto const& pores = analysis.problem().attached<Water>();
  return {std::ranges::max(pores.pressures()), pores.expelled()};
}

/// Elastic ground that drains at its top and bottom and takes no time.
template <class Grid>
scarp::Model<2> column(Grid const& grid, WaterOf<Grid> const& water, double young, double load) {
  scarp::Model<2> model(grid);
  model.fix({"left", "right"}, 0);
  model.fix({"bottom"}, 1);
  if (load != 0.0) model.surcharge({"top"}, load, TimeFunction::ramp(0.0, 1.0));
  model.material("soil", scarp::LinearElastic<2>::from_young_poisson(young, 0.25));
  model.attach(water);
  return model;
}

}  // namespace

TEST_CASE("a rejected call changes nothing of pore water") {
  auto const grid = box<Small>(2, 2);
  auto right = still_water(grid);
  right.drain({"right"});
  right.inflow({"left"}, 1e-6);
  auto const expected = after_a_second(grid, right);
  CHECK(expected.expelled == Approx(1e-6));
  auto water = still_water(grid);
  SUBCASE("inflow") {
    water.drain({"right"});
    CHECK_REFUSED(water.inflow({"left", "lefd"}, 1e-6), "lefd");
    water.inflow({"left"}, 1e-6);
  }
  SUBCASE("pressures") {
    water.prescribe({"right"}, 0.0);
    CHECK_REFUSED(water.prescribe({"bottom"}, 5e3), "given twice");
    water.inflow({"left"}, 1e-6);
  }
  SUBCASE("flow") {
    water.drain({"right"});
    water.inflow({"left"}, 1e-6);
    CHECK_REFUSED(water.region("soil", {.conductivity = 1e-3, .water = incompressible}, -1.0), "void ratio");
  }
  auto const found = after_a_second(grid, water);
  CHECK(found.expelled == expected.expelled);
  CHECK(found.pressure == expected.pressure);
}

TEST_CASE("an inflow where the pressure is given is rejected, whichever comes first") {
  auto const grid = box<Small>(2, 2);
  auto drained = still_water(grid);
  drained.drain({"right"});
  CHECK_REFUSED(drained.inflow({"right"}, 1e-6), "has no effect");
  drained.inflow({"top"}, 1e-6);  // of which one corner drains
  auto fed = still_water(grid);
  fed.inflow({"right"}, 1e-6);
  CHECK_REFUSED(fed.drain({"right"}), "has no effect");
  fed.drain({"top"});
}

TEST_CASE("a region with an inflow keeps its water when it is to be taken out") {
  auto mesh = scarp::BoxMesh<Quad8>{.cells = {2, 2}}.generate();
  mesh.regions = {"soil", "plate"};
  mesh.element_region = {0, 0, 1, 1};
  Small const grid(std::move(mesh));
  auto water = still_water(grid);
  water.drain({"right"});
  water.inflow({"left"}, 1e-6);
  auto const expected = after_a_second(grid, water);
  CHECK_REFUSED(water.exclude("plate"), "no water is around it");
  CHECK(after_a_second(grid, water).pressure == expected.pressure);
}

TEST_CASE("another flow counts in a step that has begun") {
  auto const grid = box<Small>(1, 4);
  auto const forces = [&](bool late) {
    auto water = still_water(grid);
    water.drain({"top"});
    if (late) water.at(1.0);
    water.region("soil", {.conductivity = 1e-3, .water = incompressible}, 0.7);
    water.at(1.0);
    Eigen::VectorXd increment = Eigen::VectorXd::Zero(grid.dof_count() + water.extra_dofs());
    increment.tail(water.extra_dofs()).setLinSpaced(1e-3, 2e-3);
    Eigen::VectorXd found = Eigen::VectorXd::Zero(increment.size());
    REQUIRE(water.add_forces(grid.positions(), increment, found).acceptable());
    return found;
  };
  CHECK(forces(true) == forces(false));
}

TEST_CASE("water comes in through the whole of a curved side") {
  scarp::BoxMesh<Quad8> quarter{.cells = {1, 2}};
  quarter.map = [](scarp::Vector<2> const& box) {
    double const angle = box.y() * std::numbers::pi / 2.0;
    return scarp::Vector<2>((1.0 + box.x()) * std::cos(angle), (1.0 + box.x()) * std::sin(angle));
  };
  Small const grid(quarter.generate());
  auto water = still_water(grid);
  water.drain({"right"});
  water.inflow({"left"}, 1e-6);
  double const side = grid.traction("left", scarp::Vector<2>(1.0, 0.0)).sum();
  CHECK(side == Approx(std::numbers::pi / 2.0).epsilon(1e-3));
  CHECK(after_a_second(grid, water).expelled == Approx(1e-6 * side));
}

TEST_CASE("water of the mesh before it moved is refused by a grid that has") {
  auto const grid = box<Large>(1, 2);
  auto const water_in = [](Large const& mesh) {
    WaterOf<Large> water(mesh, {.conductivity = 1e-5},
                         {.shear_modulus = 4e5, .clock = TimeFunction({{0.0, 0.0}, {1.0, 1e9}})});
    water.drain({"top"});
    return water;
  };
  scarp::Analysis analysis(column(grid, water_in(grid), 1e6, 1e5), in_steps(0.25));
  REQUIRE(analysis.to(1.0).verdict.acceptable());
  Large const moved(static_cast<Large const&>(analysis.problem().grid()));
  CHECK_REFUSED(scarp::Analysis(column(moved, water_in(grid), 1e6, 0.0), in_steps(1.0)), "other positions");
  CHECK(scarp::Analysis(column(moved, water_in(moved), 1e6, 0.0), in_steps(1.0)).to(1.0).verdict.acceptable());
}

TEST_CASE("the pressure that a model's water begins with fades as its stresses do") {
  auto const grid = box<Small>(1, 2);
  Water const undrained(grid, {.conductivity = 1e-5, .water = {.bulk_modulus = 1e8}},
                        {.shear_modulus = 4e6, .clock = TimeFunction::constant(0.0)});
  scarp::Analysis first(column(grid, undrained, 1e7, 10e3), in_steps(1.0));
  REQUIRE(first.to(1.0).verdict.acceptable());
  auto const& loaded = first.problem().attached<Water>();
  REQUIRE(std::ranges::min(loaded.pressures()) > 9e3);
  scarp::Analysis second(column(grid, loaded, 1e7, 0.0), in_steps(0.01));
  REQUIRE(second.to(0.01).verdict.acceptable());
  double const at_first = second.displacement("top", 1);
  REQUIRE(second.to(1.0).verdict.acceptable());
  CHECK(second.displacement("top", 1) > 1e-5);
  CHECK(at_first == Approx(0.01 * second.displacement("top", 1)).epsilon(1e-4));  // unbalanced forces of many steps
}

TEST_CASE("a step that suction strains too much is cut as one by a surcharge is") {
  auto const grid = box<Small>(1, 4);
  auto const steps = [&](bool by_suction) {
    Water water(grid, {.conductivity = 1e-5}, {.shear_modulus = 4e5, .clock = TimeFunction({{0.0, 0.0}, {1.0, 1e9}})});
    water.prescribe({"top", "bottom"}, by_suction ? -1e5 : 0.0, TimeFunction::ramp(0.0, 1.0));
    scarp::AnalysisSettings settings{
        .stepping = {.first = 0.1, .smallest = 1e-4, .largest = 1.0, .max_displacement_gradient = 0.01}, .threads = 1};
    scarp::Analysis analysis(column(grid, water, 1e6, by_suction ? 0.0 : 1e5), settings);
    auto const run = analysis.to(1.0);
    REQUIRE(run.verdict.acceptable());
    return run.steps;
  };
  CHECK(steps(true) == steps(false));
}

TEST_CASE("saved water is refused by water of other drains") {
  auto const grid = box<Small>(2, 2);
  auto const model = [&](std::initializer_list<std::string_view> drains) {
    auto water = still_water(grid);
    water.drain(drains);
    return held(grid, water);
  };
  scarp::Analysis saved(model({"right", "top"}), in_steps(1.0));
  REQUIRE(saved.to(1.0).verdict.acceptable());
  scarp::StateWriter writer;
  writer("analysis", saved);
  scarp::Analysis other(model({"right"}), in_steps(1.0));
  scarp::StateReader reader(writer.bits());
  reader("analysis", other);
  CHECK_REFUSED(static_cast<void>(other.to(2.0)), "unknown pressures");
}

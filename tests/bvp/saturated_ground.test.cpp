// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "../../examples/consolidation/strip.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/points/laboratory_paths.hpp"
#include "scarp/points/point_path.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/solver/make_problem.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"

namespace {

using samples::Approx;
using scarp::ConstantPermeability;
using scarp::PoreWater;
using scarp::Quad8;
using scarp::Tri6;
using scarp::Vector;

template <class Element, class Motion = scarp::SmallStrain>
using Ground = scarp::Discretisation<Element, Motion>;

constexpr scarp::Water incompressible{.bulk_modulus = std::numeric_limits<double>::infinity()};

/// Follows the pressure in the middle of a cylinder.
template <class Water>
struct Middle {
  std::size_t node = 0;
  double peak = 0.0;
  double time = 0.0;

  void attempted(auto const& problem, scarp::StepReport const& report) {
    auto const& water = problem.template attached<Water>();
    if (double const now = water.pressures()[node]; report.verdict.acceptable() && now > peak) {
      peak = now;
      time = water.time();
    }
  }
  static bool wants_stop() { return false; }
};

/// A quarter of a cylinder of radius 1 under a radial pressure of 1, drained outside, in time.
/// \return largest pressure in the middle, and its T = c_v t
template <class Element>
std::pair<double, double> mandel_cryer(int cells, double poisson) {
  double const young = 1e6;
  double const shear = young / (2.0 * (1.0 + poisson));
  double const modulus = 2.0 * shear * (1.0 - poisson) / (1.0 - 2.0 * poisson);
  auto const to_disc = [](Vector<2> const& box) {
    return Vector<2>(box.x() * std::sqrt(1.0 - box.y() * box.y() / 2.0),
                     box.y() * std::sqrt(1.0 - box.x() * box.x() / 2.0));
  };
  Ground<Element> const grid(scarp::BoxMesh<Element>{.cells = {cells, cells}, .map = to_disc}.generate());
  consolidation::Clock clock(1e-4);
  double const end = clock.add(0.2, 200);
  PoreWater water(grid, ConstantPermeability{incompressible.unit_weight / modulus, incompressible},
                  {.shear_modulus = shear, .clock = clock.time()});
  water.drain({"right", "top"});
  scarp::Constraints constraints(grid, water.extra_dofs());
  for (int const node : grid.boundary_nodes("left")) constraints.fix(node, 0);
  for (int const node : grid.boundary_nodes("bottom")) constraints.fix(node, 1);
  // Forces of a radial pressure: those of a stress of -1 in all directions, which nothing but the outer boundary
  // carries.
  std::vector<scarp::VoigtStress<2>> const all_round(static_cast<std::size_t>(grid.point_count()), {-1.0, -1.0, 0.0});
  Eigen::VectorXd pressed;
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), all_round, pressed);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(constraints.dof_count());
  forces.head(pressed.size()) = pressed;
  scarp::LoadHistory loads;
  loads.add(forces, scarp::TimeFunction::ramp(0.0, 1.0));
  scarp::SerialExecutor serial;
  scarp::Region const soil{"soil", scarp::LinearElastic<2>::from_young_poisson(young, poisson)};
  auto problem = make_problem(grid, 1.0, boost::hana::make_tuple(soil), constraints, loads, serial, water);
  Middle<decltype(water)> middle;
  for (std::size_t node = 0; node < grid.nodes().size(); ++node)
    if (grid.nodes()[node].norm() < 1e-12) middle.node = node;
  auto const run = consolidation::by_the_clock.run(scarp::QuasiNewton<>{}, problem, 0.0, end, middle);
  REQUIRE(run.verdict.acceptable());
  CHECK(run.iterations == run.steps);
  return {middle.peak, middle.time};
}

/// Bearing pressure of a rigid smooth strip on undrained ground over its undrained shear strength.
template <class Element, class Rule>
double undrained_bearing(int cells, double friction, double cohesion, double tolerance) {
  constexpr double pressure = 100e3;  // all round, effective [Pa]
  double const strength = cohesion * std::cos(friction) + pressure * std::sin(friction);
  double const young = 500.0 * strength;
  auto mesh = scarp::BoxMesh<Element>{.lengths = Vector<2>(5.0, 3.0), .cells = {5 * cells, 3 * cells}}.generate();
  Ground<Element> const grid(std::move(mesh));
  PoreWater water(grid, ConstantPermeability{.water = incompressible},
                  {.shear_modulus = young / 2.6, .clock = scarp::TimeFunction::constant(0.0)});
  scarp::Constraints constraints(grid, water.extra_dofs());
  for (auto const* wall : {"left", "right"})
    for (int const node : grid.boundary_nodes(wall)) constraints.fix(node, 0);
  for (int const node : grid.boundary_nodes("bottom")) {
    if (!constraints.is_prescribed(2 * node)) constraints.fix(node, 0);
    constraints.fix(node, 1);
  }
  std::vector<int> base;
  for (int const node : grid.boundary_nodes("top")) {
    if (grid.nodes()[static_cast<std::size_t>(node)].x() > 1.0 + 1e-9) continue;
    base.push_back(node);
    constraints.move(node, 1, -1.0);
  }
  Eigen::VectorXd load = Eigen::VectorXd::Zero(constraints.dof_count());
  load.head(grid.dof_count()) = grid.traction("top", {0.0, -pressure});
  scarp::MohrCoulomb<2, scarp::GeostaticStress<2>> const soil{
      .elasticity = scarp::IsotropicElasticity::from_young_poisson(young, 0.3),
      .strength = {{.cohesion = cohesion, .friction = friction}},
      .initial = {.surcharge = pressure}};
  scarp::SerialExecutor serial;
  auto problem = make_problem(grid, 3.0, boost::hana::make_tuple(scarp::Region{"soil", soil}), constraints,
                              scarp::LoadHistory(load), serial, water);
  scarp::QuasiNewton<Rule> const newton{.tolerance = tolerance};
  scarp::LoadStepping const stepping{
      .first = 1e-4, .smallest = 1e-7, .largest = 2e-3, .max_displacement_gradient = 0.02};
  scarp::NoObserver nobody;
  auto const run = stepping.run(newton, problem, 0.0, 0.04, nobody);
  REQUIRE(run.verdict.acceptable());
  auto const unbalanced = problem.evaluate_committed().unbalanced;
  double force = 0.0;
  for (int const node : base) force -= unbalanced(2 * node + 1);
  MESSAGE("bearing over s_u ", force / strength, ", with the half element at the edge ",
          force / strength / (1.0 + 0.25 / cells), ", ", run.iterations, " iterations in ", run.steps, " steps");
  return force / strength / (1.0 + 0.25 / cells);  // the base holds half of the element beyond its edge
}

}  // namespace

TEST_CASE("the pressure in the middle of a cylinder rises before it falls, as De Leeuw's") {
  // Analytic: peak 1.1841 at T = 0.0563 for Poisson's ratio 0.2 (De Leeuw 1965; transform inverted by Talbot's method).
  auto const check = [](std::pair<double, double> const& found) {
    MESSAGE("peak ", found.first, " at T ", found.second);
    CHECK(std::abs(found.first - 1.1841) < 3e-3);
    CHECK(std::abs(found.second - 0.0563) < 2.5e-3);  // half of a time step at the peak, which is flat
  };
  check(mandel_cryer<Quad8>(12, 0.2));
  check(mandel_cryer<Tri6>(12, 0.2));
  check(mandel_cryer<scarp::Quad4>(12, 0.2));
}

TEST_CASE("a strip load on a half plane consolidates as McNamee and Gibson's") {
  auto const& forms = consolidation::strips[1];
  auto const found = consolidation::press<Quad8>(forms, {.distance = 40.0, .within = 6, .steps = 10});
  REQUIRE(found.run.verdict.acceptable());
  CHECK(found.at_once == Approx(0.5).epsilon(0.01));
  for (std::size_t k = 0; k < forms.pressure.size(); ++k) CHECK(std::abs(found.pressure[k] - forms.pressure[k]) < 0.02);
  for (std::size_t k = 0; k < forms.settlement.size(); ++k)
    CHECK(std::abs(found.settlement[k] - forms.settlement[k]) < 0.02);
}

TEST_CASE("undrained Mohr-Coulomb ground carries (2 + pi) s_u below a strip") {
  double const exact = 2.0 + std::numbers::pi;
  // Plane strain without dilation keeps the mean effective stress: s_u = c cos(phi) + p sin(phi).
  double const friction = 25.0 * std::numbers::pi / 180.0;
  CHECK(std::abs(undrained_bearing<Quad8, scarp::ConsistentTangent>(6, friction, 10e3, 1e-5) / exact - 1.0) < 0.02);
  CHECK(std::abs(undrained_bearing<Tri6, scarp::PointwiseBroyden>(6, friction, 10e3, 1e-3) / exact - 1.0) < 0.03);
}

TEST_CASE("a saturated packing in one element follows the path of constant volume") {
  using Grains = samples::Discs;
  scarp::LinearFrictional const law{.normal_stiffness = 1e8, .tangential_stiffness = 5e7, .friction = 0.5};
  for (double const preparation : {0.0, 0.1}) {  // dense, medium
    scarp::Cloud<scarp::DiscGrading> const cloud{
        .grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = 400, .density = 2650.0, .thickness = 1.0, .seed = 1};
    auto const made = scarp::IsotropicPreparation{.pressure = 1e5, .preparation_friction = preparation}.prepare(
        cloud.make<Grains>(), law);
    scarp::DemRve<Grains, scarp::SamePacking<Grains>> const sand{
        .law = law, .source = {made.packing}, .pressure_floor = 1e3};
    scarp::SerialExecutor serial;
    scarp::MaterialPoints<2> alone(sand, std::array{scarp::Site<2>{}});
    scarp::PointPath<2> path(alone, scarp::undrained_path<2>(), {.tolerance = 1e-4});
    scarp::VoigtStress<2> const start = alone.committed_stress(0);

    Ground<Quad8, scarp::UpdatedLagrangian> const grid(scarp::BoxMesh<Quad8>{.cells = {1, 1}}.generate());
    PoreWater water(
        grid, scarp::KozenyCarman{.grain = 5e-3},
        {.shear_modulus = 4e7, .void_ratio = made.packing.void_ratio(), .clock = scarp::TimeFunction::constant(0.0)});
    scarp::Constraints constraints(grid, water.extra_dofs());
    for (int const node : grid.boundary_nodes("left")) constraints.fix(node, 0);
    for (int const node : grid.boundary_nodes("bottom")) constraints.fix(node, 1);
    for (int const node : grid.boundary_nodes("top")) constraints.move(node, 1, -1.0);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(constraints.dof_count());
    load.head(grid.dof_count()) = grid.traction("right", {start(0), 0.0});
    auto problem = make_problem(grid, 1.0, boost::hana::make_tuple(scarp::Region{"soil", sand}), constraints,
                                scarp::LoadHistory(load), serial, water);
    scarp::QuasiNewton<scarp::PointwiseBroyden> const newton{.tolerance = 1e-3};
    constexpr double step = 1e-3;
    scarp::LoadStepping const stepping{
        .first = step, .smallest = step / 1024.0, .largest = step, .max_displacement_gradient = 0.1};
    scarp::NoObserver nobody;
    scarp::RunReport whole;
    for (int k = 0; k < 5; ++k) {
      REQUIRE(path.advance(step, serial).verdict.acceptable());
      auto const run =
          stepping.run(newton, problem, 1.0 - std::exp(-step * k), 1.0 - std::exp(-step * (k + 1)), nobody);
      REQUIRE(run.verdict.acceptable());
      whole = joined(whole, run);
      scarp::VoigtStress<2> mean = scarp::VoigtStress<2>::Zero();
      for (int point = 0; point < grid.point_count(); ++point)
        mean += problem.points().committed_stress(point) / grid.point_count();
      scarp::VoigtStress<2> const expected = path.stress(0);
      // The points of the element bifurcate, and a pressure that is linear in it lets them exchange water; measured 2.8
      // %, medium.
      double const bar = (preparation == 0.0 ? 0.02 : 0.03) * std::abs(start(0));
      CHECK(std::abs((mean(0) - mean(1)) - (expected(0) - expected(1))) < bar);        // q
      CHECK(std::abs((mean(0) + mean(1)) - (expected(0) + expected(1))) / 2.0 < bar);  // p'
      auto const pressures = problem.attached<decltype(water)>().pressures();
      // Points that bifurcate leave pressures that differ, of which the mean carries the loads.
      double const excess =
          std::accumulate(pressures.begin(), pressures.end(), 0.0) / static_cast<double>(pressures.size());
      // The lateral load is a force, and the side that it acts on shrinks.
      CHECK((mean(0) - excess) * std::exp(-step * (k + 1)) == Approx(start(0)).epsilon(2e-3));
    }
    MESSAGE("preparation friction ", preparation, ": ", whole.iterations, " iterations in ", whole.steps, " steps");
  }
}

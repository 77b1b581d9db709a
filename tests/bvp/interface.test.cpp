// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/interface.hpp"

#include <doctest/doctest.h>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/standing_body.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/approx.hpp"
#include "support/crossed_rectangle.hpp"
#include "support/refusals.hpp"

namespace {

using Grid = scarp::Discretisation<scarp::Tri3>;
using Soil = scarp::LinearElastic<2>;
using Tied = scarp::CohesiveBond<scarp::LinearFrictional>;
template <class Law>
using Footed = scarp::Interface<Law, scarp::RigidFooting>;
using Problem = scarp::EquilibriumProblem<Grid>;
using Newton = scarp::QuasiNewton<>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A rigid footing of 2 m in the middle of a block of 6 m x 2 m.
struct Bed {
  double young = 20e6;
  bool rigid_ground = false;
  int columns = 12;
  double width = 2.0;
  double thickness = 1.0;
  int missing_dofs = 0;
  scarp::SerialExecutor executor{};

  template <class Law>
  Problem problem(Law const& law, scarp::Vector<2> const& force, double moment,
                  scarp::TimeFunction const& amplitude = {}) {
    samples::CrossedRectangle const shape{.width = 6.0, .height = 2.0, .columns = columns, .rows = columns / 3};
    Grid grid(shape.generate());
    auto const& mesh = grid.mesh();
    scarp::Constraints constraints(mesh, scarp::RigidBody::extra_dofs);
    if (rigid_ground) {
      for (int n = 0; n < grid.node_count(); ++n) constraints.fix(n);
    } else {
      for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node);
      for (int const node : boundary_nodes(mesh, "left")) constraints.fix(node, 0);
      for (int const node : boundary_nodes(mesh, "right")) constraints.fix(node, 0);
    }
    scarp::FacetChain ground(boundary(mesh, "top"));
    std::vector<double> breaks;
    for (int const node : boundary_nodes(mesh, "top")) breaks.push_back(mesh.nodes[static_cast<std::size_t>(node)].x());
    double const arm = width / 2.0;
    scarp::RigidFooting const footing({{3.0, 2.0}, arm}, {3.0 - arm, 2.0}, {3.0 + arm, 2.0}, breaks, thickness,
                                      grid.dof_count() - missing_dofs);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(grid.dof_count() + 3);
    load.tail<3>() << force, moment / arm;
    scarp::LoadHistory loads(Eigen::VectorXd::Zero(load.size()));
    loads.add(load, amplitude);
    std::vector<scarp::Site<2>> sites;
    for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 2.0));
    scarp::MaterialPoints<2> points(Soil::from_young_poisson(young, 0.3), sites);
    Footed<Law> interface(law, footing, ground, mesh.nodes);
    return {std::move(grid),  std::move(points), std::move(constraints),
            std::move(loads), executor,          std::move(interface)};
  }
};

scarp::LoadStepping one_step() { return {.first = 1.0, .max_displacement_gradient = 1.0}; }

}  // namespace

TEST_CASE("a footing has the thickness of its mesh and follows its degrees of freedom") {
  scarp::LinearFrictional const springs{.normal_stiffness = 5e7, .tangential_stiffness = 5e7, .friction = 0.5};
  auto const placed = [&](Bed bed) { return bed.problem(springs, {0.0, -1.0}, 0.0); };
  CHECK_REFUSED(placed({.thickness = 2.0}), "is 2 m thick out of the plane (the mesh is 1 m)");
  CHECK_REFUSED(placed({.missing_dofs = 2}), "give that as dofs_before");
}

TEST_CASE("a law that an interface cannot have is refused") {
  auto const placed = [](double normal, double tangential, double friction) {
    return Bed{}.problem(scarp::LinearFrictional{normal, tangential, friction}, {0.0, -1.0}, 0.0);
  };
  CHECK_REFUSED(placed(0.0, 1e8, 0.5), "normal stiffness of an interface");
  CHECK_REFUSED(placed(1e8, -1e8, 0.5), "tangential stiffness of an interface");
  CHECK_REFUSED(placed(1e8, 1e8, -0.5), "friction of an interface");
}

TEST_CASE("the points of a footing are at their places before the first step") {
  scarp::LinearFrictional const springs{.normal_stiffness = 5e7, .tangential_stiffness = 5e7, .friction = 0.5};
  auto const problem = Bed{}.problem(springs, {0.0, -1.0}, 0.0);
  for (auto const& point : problem.attached<Footed<scarp::LinearFrictional>>().points()) {
    CHECK(point.place.y() == samples::Approx(2.0));
    CHECK(std::abs(point.place.x() - 3.0) < 1.0);
  }
}

TEST_CASE("a rigid footing on springs settles and tilts as Winkler's bed") {
  Bed bed{.rigid_ground = true};
  double const k = 50e6;
  scarp::LinearFrictional const springs{.normal_stiffness = k, .tangential_stiffness = k, .friction = 0.5};
  double const force = 200e3;
  double const moment = 20e3;  // inside the core: W/M = 0.1 m < B/6, so that nothing lifts
  auto problem = bed.problem(springs, {0.0, -force}, moment);
  scarp::NoObserver no_observer;
  auto const run = one_step().run(Newton{.tolerance = 1e-9}, problem, 0.0, 1.0, no_observer);
  REQUIRE(run.verdict.acceptable());
  auto const& body = problem.attached<Footed<scarp::LinearFrictional>>().body().body();
  // Analytic: settlement W/(k B), tilt M/(k B^3/12); second order in the tilt, 1e-7.
  CHECK(2.0 - body.reference().y() == samples::Approx(force / (k * 2.0)).epsilon(1e-6));
  CHECK(body.rotation() == samples::Approx(moment / (k * 8.0 / 12.0)).epsilon(1e-6));
}

TEST_CASE("the part of a footing that overhangs the ground carries nothing") {
  Bed bed{.rigid_ground = true, .width = 8.0};  // a metre beyond both ends of the block
  double const k = 50e6;
  scarp::LinearFrictional const springs{.normal_stiffness = k, .tangential_stiffness = k, .friction = 0.5};
  double const force = 200e3;
  auto problem = bed.problem(springs, {0.0, -force}, 0.0);
  scarp::NoObserver no_observer;
  REQUIRE(one_step().run(Newton{.tolerance = 1e-9}, problem, 0.0, 1.0, no_observer).verdict.acceptable());
  // Analytic: Winkler's bed over the 6 m of the block.
  CHECK(2.0 - problem.attached<Footed<scarp::LinearFrictional>>().body().body().reference().y() ==
        samples::Approx(force / (k * 6.0)).epsilon(1e-6));
}

TEST_CASE("a footing loaded outside its core lifts: the pressures are a triangle, none is negative, forces balance") {
  Bed bed{.rigid_ground = true, .columns = 96};
  double const k = 50e6;
  scarp::LinearFrictional const springs{.normal_stiffness = k, .tangential_stiffness = k, .friction = 0.5};
  double const force = 200e3;
  double const eccentricity = 0.5;
  auto problem = bed.problem(springs, {0.0, -force}, force * eccentricity);
  scarp::NoObserver no_observer;
  auto const run = one_step().run(Newton{.tolerance = 1e-9}, problem, 0.0, 1.0, no_observer);
  REQUIRE(run.verdict.acceptable());
  CHECK(run.refused == 0);
  double sum = 0.0;
  double contact = 0.0;
  double highest = 0.0;
  for (auto const& point : problem.attached<Footed<scarp::LinearFrictional>>().points()) {
    CHECK(point.pressure >= 0.0);
    sum += point.stress.y() * point.area;
    if (point.pressure > 0.0) contact += point.area;
    highest = std::max(highest, point.pressure);
  }
  // Analytic: contact length 3 (B/2 - e), edge pressure 2 W/length; the points do not reach the edge and the last
  // touching one is a sixteenth of the width, 2/32, wide.
  double const length = 3.0 * (1.0 - eccentricity);
  CHECK(sum == samples::Approx(force).epsilon(1e-9));
  CHECK(std::abs(contact - length) < 2.0 / 32.0);
  CHECK(highest == samples::Approx(2.0 * force / length).epsilon(0.03));
}

TEST_CASE("a block slides when the tangential load passes friction, not before") {
  Bed bed{.rigid_ground = true};
  double const mu = 0.4;
  scarp::LinearFrictional const law{.normal_stiffness = 1e9, .tangential_stiffness = 1e9, .friction = mu};
  double const weight = 100e3;
  auto problem = bed.problem(law, {weight, 0.0}, 0.0);  // load factor = horizontal over vertical load
  Eigen::VectorXd dead = Eigen::VectorXd::Zero(problem.dof_count());
  dead(problem.dof_count() - 2) = -weight;
  scarp::LoadHistory loads(dead);
  Eigen::VectorXd push = Eigen::VectorXd::Zero(problem.dof_count());
  push(problem.dof_count() - 3) = weight;
  loads.add(push, {});
  auto grid = problem.discretisation();
  scarp::SerialExecutor executor;
  Problem sliding(grid, problem.points(), problem.constraints(), loads, executor,
                  problem.attached<Footed<scarp::LinearFrictional>>());
  scarp::NoObserver no_observer;
  scarp::LoadStepping const stepping{.first = 0.05, .smallest = 1e-7, .max_displacement_gradient = 1.0};
  Newton const newton{.tolerance = 1e-9, .max_iterations = 12};
  REQUIRE(stepping.settle(newton, sliding, 0.0, no_observer).verdict.acceptable());
  auto const run = stepping.run(newton, sliding, 0.0, 1.0, no_observer);
  // Analytic: tan(theta) = mu.
  CHECK_FALSE(run.verdict.acceptable());
  CHECK(run.load <= mu * (1.0 + 1e-6));
  CHECK(run.load == samples::Approx(mu).epsilon(1e-5));
}

TEST_CASE("a base that slides over a kink of the ground changes its force continuously") {
  // Ground of two facets, the right one falls by 0.3 over 1; a rigid base with one pair of points presses into both in
  // turn.
  std::vector<scarp::Vector<2>> const nodes{{-1.0, 0.0}, {0.0, 0.0}, {1.0, -0.3}};
  scarp::FacetChain const ground({{1, 0}, {2, 1}});
  scarp::LinearFrictional const law{.normal_stiffness = 1e6, .tangential_stiffness = 1e6, .friction = 0.5};
  scarp::RigidFooting const base({{-0.2, -0.01}, 0.1}, {-0.3, -0.01}, {-0.1, -0.01}, {}, 1.0, 6);
  Footed<scarp::LinearFrictional> interface(law, base, ground, nodes);
  auto const force_at = [&](double x) {
    Eigen::VectorXd increment = Eigen::VectorXd::Zero(9);
    increment(6) = x;
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(9);
    REQUIRE(interface.add_forces(nodes, increment, forces).acceptable());
    return forces;
  };
  constexpr double step = 1e-5;
  double largest = 0.0;
  for (double x = 0.0; x < 0.35; x += step) largest = std::max(largest, (force_at(x + step) - force_at(x)).norm());
  // Springs of 1e6 N/m3 on 0.2 m2, two directions, two sides: below 1e6 N/m of change.
  CHECK(largest > 0.0);
  CHECK(largest < 1e6 * step);
}

TEST_CASE("the stiffness of a base that slides along a slope is the derivative of its force") {
  std::vector<scarp::Vector<2>> const nodes{{0.0, 0.0}, {1.0, -0.3}};
  scarp::LinearFrictional const law{.normal_stiffness = 1e6, .tangential_stiffness = 1e6, .friction = 0.5};
  scarp::RigidFooting const base({{0.5, -0.2}, 0.1}, {0.4, -0.2}, {0.6, -0.2}, {}, 1.0, 4);
  Footed<scarp::LinearFrictional> interface(law, base, scarp::FacetChain({{1, 0}}), nodes);
  auto const force_at = [&](double x, double y) {
    Eigen::VectorXd increment = Eigen::VectorXd::Zero(7);
    increment.segment<2>(4) << x, y;
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(7);
    REQUIRE(interface.add_forces(nodes, increment, forces).acceptable());
    return forces;
  };
  constexpr double step = 1e-6;
  Eigen::Matrix<double, 7, 2> slopes;
  slopes << (force_at(0.1 + step, -0.01) - force_at(0.1 - step, -0.01)),
      (force_at(0.1, -0.01 + step) - force_at(0.1, -0.01 - step));
  slopes /= 2.0 * step;
  force_at(0.1, -0.01);
  std::vector<Eigen::Triplet<double>> entries;
  interface.add_stiffness(entries);
  Eigen::SparseMatrix<double> stiffness(7, 7);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  Eigen::Matrix2d const own = Eigen::MatrixXd(stiffness).block<2, 2>(4, 4);
  // Analytic: it slides, and the overlap shrinks by the slope. Round-off of places, 1e-16 over the step.
  CHECK(slopes(4, 0) == samples::Approx(-0.5 * 1e6 * 0.3 * 0.2).epsilon(1e-6));
  // Linear within the steps, of which those of the interface are 1e-9 of the facet, with overlaps of 0.04 of it.
  CHECK((own - slopes.middleRows<2>(4)).norm() < 1e-6 * own.norm());
}

TEST_CASE("a bonded interface holds tension up to its strength and has none once it is broken") {
  Bed bed{.rigid_ground = true};
  double const strength = 30e3;
  Tied const bonded{{.normal_stiffness = 1e9, .tangential_stiffness = 1e9, .friction = 0.5}, strength, infinity};
  scarp::NoObserver no_observer;
  for (double const share : {0.99, 1.01}) {
    auto problem = bed.problem(bonded, {0.0, share * strength * bed.width}, 0.0);
    auto const run = scarp::LoadStepping{.first = 0.25, .smallest = 1e-3, .max_displacement_gradient = 1.0}.run(
        Newton{.tolerance = 1e-9}, problem, 0.0, 1.0, no_observer);
    CHECK(run.verdict.acceptable() == (share < 1.0));
    if (share > 1.0) CHECK(run.load == samples::Approx(1.0 / share).epsilon(3e-3));
  }
}

TEST_CASE("a stiff tied interface carries the load of a footing on an elastic bed: Newton converges at once") {
  Bed bed{.columns = 24};
  Tied const tied{{.normal_stiffness = 1e10, .tangential_stiffness = 1e10, .friction = 0.0}, infinity, infinity};
  auto problem = bed.problem(tied, {0.0, -1e3}, 50.0);
  scarp::NoObserver no_observer;
  // Places of 3 m are rounded to 4e-16 m, times 1e10 Pa/m and 0.1 m2 at every point: about 1e-8 of the load.
  Newton const newton{.tolerance = 1e-7};
  auto const run = one_step().run(newton, problem, 0.0, 1.0, no_observer);
  REQUIRE(run.verdict.acceptable());
  CHECK(run.iterations <= 5);
  auto const& body = problem.attached<Footed<Tied>>().body().body();
  CHECK(body.reference().y() < 2.0);
  CHECK(body.rotation() > 0.0);
  double sum = 0.0;
  for (auto const& point : problem.attached<Footed<Tied>>().points()) sum += point.pressure * point.area;
  CHECK(sum == samples::Approx(1e3).epsilon(1e-6));
}

TEST_CASE("two elastic blocks on top of each other carry a uniform pressure, whether or not their nodes meet") {
  // The contact patch test: block 1 m x 1 m on block 1 m x 1 m, different numbers of columns.
  for (int const upper_columns : {4, 7}) {
    auto lower = samples::CrossedRectangle{.width = 1.0, .height = 1.0, .columns = 4, .rows = 4}.generate();
    auto const upper =
        samples::CrossedRectangle{.width = 1.0, .height = 1.0, .columns = upper_columns, .rows = upper_columns}
            .generate();
    int const offset = static_cast<int>(lower.nodes.size());
    for (auto const& node : upper.nodes) lower.nodes.emplace_back(node + scarp::Vector<2>::UnitY());
    auto const shifted = [&](auto numbers) {
      for (int& number : numbers) number += offset;
      return numbers;
    };
    for (auto const& element : upper.elements) {
      lower.elements.push_back(shifted(element));
      lower.element_region.push_back(0);
    }
    for (auto const& [name, facets] : upper.boundaries) {
      for (auto const& facet : facets) lower.boundaries["upper_" + name].push_back(shifted(facet));
    }
    Grid grid(lower);
    auto const& mesh = grid.mesh();
    scarp::Constraints constraints(mesh);
    for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node, 1);
    for (char const* side : {"left", "upper_left"}) {
      for (int const node : boundary_nodes(mesh, side)) constraints.fix(node, 0);
    }
    for (char const* side : {"right", "upper_right"}) {
      for (int const node : boundary_nodes(mesh, side)) constraints.fix(node, 0);
    }
    double const pressure = 1e3;
    Eigen::VectorXd const load = grid.traction("upper_top", scarp::Vector<2>(0.0, -pressure));
    scarp::LoadHistory loads(Eigen::VectorXd::Zero(load.size()));
    loads.add(load, {});
    std::vector<double> breaks;
    for (int const node : boundary_nodes(mesh, "top")) breaks.push_back(mesh.nodes[static_cast<std::size_t>(node)].x());
    scarp::MeshedFooting const footing(scarp::FacetChain(boundary(mesh, "upper_bottom")), breaks, mesh.nodes, 1.0);
    using Law = scarp::LinearFrictional;
    using Contact = scarp::Interface<Law, scarp::MeshedFooting>;
    Contact interface(Law{.normal_stiffness = 1e9, .tangential_stiffness = 1e9, .friction = 0.3}, footing,
                      scarp::FacetChain(boundary(mesh, "top")), mesh.nodes);
    std::vector<scarp::Site<2>> sites;
    for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 2.0));
    scarp::SerialExecutor executor;
    Problem problem(grid, {Soil::from_young_poisson(20e6, 0.3), sites}, constraints, loads, executor, interface);
    scarp::NoObserver no_observer;
    auto const run = one_step().run(Newton{.tolerance = 1e-9}, problem, 0.0, 1.0, no_observer);
    REQUIRE(run.verdict.acceptable());
    // Analytic: vertical stress -p everywhere; updated-Lagrangian width is kept by the sides. Round-off of the
    // contact's stiffness over the soil's, 50, times the residual.
    for (auto const& stress : problem.committed_stresses())
      CHECK(stress(1) == samples::Approx(-pressure).epsilon(1e-9));
    for (auto const& point : problem.attached<Contact>().points())
      CHECK(point.pressure == samples::Approx(pressure).epsilon(1e-9));
  }
}

TEST_CASE("an interface commits the state of the increment, whatever forces were requested last") {
  using Law = scarp::LinearFrictional;
  auto const state_of = [](bool looks_back) {
    Bed bed{.rigid_ground = true};
    auto problem = bed.problem(Law{5e7, 5e7, 0.5}, {0.0, 0.0}, 0.0);
    Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem.dof_count());
    CHECK(problem.attached_stiffness().norm() == 0.0);  // nothing was requested yet
    Eigen::VectorXd increment = still;
    increment(problem.first_beside()) = 2e-4;
    increment(problem.first_beside() + 1) = -1e-3;
    static_cast<void>(problem.evaluate(increment));
    if (looks_back) static_cast<void>(problem.attached_forces(still));
    problem.commit(increment);
    return problem.attached<Footed<Law>>().points()[0];
  };
  auto const expected = state_of(false);
  auto const found = state_of(true);
  CHECK(expected.pressure > 0.0);
  CHECK(found.pressure == expected.pressure);
  CHECK(found.shear == expected.shear);
}

TEST_CASE("an increment is not committed at another load than that it was evaluated at") {
  Bed bed;
  auto problem = bed.problem(scarp::LinearFrictional{5e7, 5e7, 0.5}, {0.0, -1e3}, 0.0);
  Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem.dof_count());
  problem.set_load(0.5);
  static_cast<void>(problem.evaluate(still));
  problem.set_load(1.0);
  CHECK_REFUSED(problem.commit(still), "evaluate it first");
}

// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/interface.hpp"
#include "scarp/bvp/standing_body.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/approx.hpp"
#include "support/crossed_rectangle.hpp"

namespace {

using Grid = scarp::Discretisation<scarp::Tri3>;
using Soil = scarp::LinearElastic<2>;
using Contact = scarp::Interface<scarp::LinearFrictional, scarp::RigidFooting>;
using Problem = scarp::EquilibriumProblem<Grid>;

constexpr double friction = 0.5;
constexpr double stiffness = 1e8;  // [Pa/m]
constexpr double weight = 74e3;    // [N]: 37 kPa on 2 m, so that 0.2 mm of slip is elastic

/// Ground of 6 m whose nodes move as `motion` says, and a footing on it, 2 m wide with its centre at 3 m; its weight is
/// there from the start. above [m]: where the base floats at first, over the ground. scale: of all lengths, at equal
/// stresses; the motion is given for the scale 1
template <class Motion>
Problem moved_ground(scarp::SerialExecutor& executor, Motion const& motion, double above = 0.0, double scale = 1.0) {
  Grid grid(
      samples::CrossedRectangle{.width = 6.0 * scale, .height = 2.0 * scale, .columns = 12, .rows = 4}.generate());
  auto const& mesh = grid.mesh();
  scarp::Constraints constraints(mesh, scarp::RigidBody::extra_dofs);
  for (int n = 0; n < grid.node_count(); ++n) {
    scarp::Vector<2> const rate = scale * motion(scarp::Vector<2>(mesh.nodes[static_cast<std::size_t>(n)] / scale));
    for (int axis = 0; axis < 2; ++axis) constraints.move(n, axis, rate(axis));
  }
  std::vector<double> breaks;
  for (int const node : boundary_nodes(mesh, "top")) breaks.push_back(mesh.nodes[static_cast<std::size_t>(node)].x());
  double const base = (2.0 + above) * scale;
  scarp::RigidFooting const footing({{3.0 * scale, base}, scale}, {2.0 * scale, base}, {4.0 * scale, base}, breaks, 1.0,
                                    grid.dof_count());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(grid.dof_count() + 3);
  load(grid.dof_count() + 1) = -weight * scale;
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 2.0));
  scarp::MaterialPoints<2> points(Soil::from_young_poisson(20e6, 0.3), sites);
  double const spring = stiffness / scale;
  Contact contact({.normal_stiffness = spring, .tangential_stiffness = spring, .friction = friction}, footing,
                  scarp::FacetChain(boundary(mesh, "top")), mesh.nodes);
  return {std::move(grid), std::move(points), std::move(constraints), scarp::LoadHistory(std::move(load)),
          executor,        std::move(contact)};
}

/// In one step; a refused one is tried again in smaller ones, down to the smallest.
scarp::RunReport in_one_step(Problem& problem, double smallest = 0.9) {
  scarp::LoadStepping const stepping{.first = 1.0, .smallest = smallest, .max_displacement_gradient = 1.0};
  scarp::QuasiNewton<> const newton{.tolerance = 1e-9};
  scarp::NoObserver no_observer;
  auto const settled = stepping.settle(newton, problem, 0.0, no_observer);
  REQUIRE(settled.verdict.acceptable());
  return stepping.run(newton, problem, 0.0, 1.0, no_observer);
}

}  // namespace

TEST_CASE(
    "a footing on ground that is drawn out below it slides everywhere and goes with the ground below its middle") {
  for (double const strain : {1e-3, 1e-2, 5e-2, -5e-2}) {
    CAPTURE(strain);
    scarp::SerialExecutor executor;
    // Drawn out about x = 0: the ground below the footing's middle goes 3 m times the strain.
    auto problem = moved_ground(executor, [&](auto const& place) { return scarp::Vector<2>(strain * place.x(), 0.0); });
    auto const run = in_one_step(problem);
    CHECK(run.verdict.acceptable());
    CHECK(run.refused == 0);
    // Analytic: friction of both halves is in balance as long as what does not slide is between the two points next to
    // the middle, 0.106 m from it each (Gauss points of facets of 0.5 m), and to the elastic slip.
    double const elastic = friction * weight / 2.0 / stiffness;
    double const between = 0.25 * (1.0 - 1.0 / std::sqrt(3.0)) * std::abs(strain);
    CHECK(std::abs(problem.attached<Contact>().body().body().reference().x() - 3.0 * (1.0 + strain)) <
          elastic + between);
    double across = 0.0;
    double up = 0.0;
    for (auto const& point : problem.attached<Contact>().points()) {
      across += point.stress.x() * point.area;
      up += point.stress.y() * point.area;
    }
    CHECK(std::abs(across) < 1e-8 * weight);
    CHECK(up == samples::Approx(weight).epsilon(1e-8));
  }
}

TEST_CASE("a footing that floats above its ground is let down on it") {
  for (double const above : {1e-7, 1e-5, 1e-2}) {
    CAPTURE(above);
    scarp::SerialExecutor executor;
    auto problem = moved_ground(
        executor, [](auto const&) { return scarp::Vector<2>(0.0, 0.0); }, above);
    auto const run = in_one_step(problem);
    CHECK(run.verdict.acceptable());
    double up = 0.0;
    for (auto const& point : problem.attached<Contact>().points()) up += point.stress.y() * point.area;
    CHECK(up == samples::Approx(weight).epsilon(1e-8));
  }
}

TEST_CASE(
    "a footing balances wherever rough ground goes, nearly always in one step, on slopes less steep than friction") {
  constexpr int draws = 100;
  std::mt19937 random(1700);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  int refused = 0;
  for (int draw = 0; draw < draws; ++draw) {
    CAPTURE(draw);
    scarp::SerialExecutor executor;
    // A slope, a stretch, a shift and a wave.
    double const slope = 0.15 * part(random);
    double const strain = 0.03 * part(random);
    double const wave = 0.03 * part(random);
    scarp::Vector<2> const shift(0.2 * part(random), 0.2 * part(random));
    auto problem = moved_ground(executor, [&](auto const& place) -> scarp::Vector<2> {
      return scarp::Vector<2>(strain * place.x(), slope * place.x() + wave * std::sin(3.0 * place.x())) + shift;
    });
    auto const run = in_one_step(problem, 0.01);
    CHECK(run.verdict.acceptable());
    if (run.refused > 0) ++refused;
    double up = 0.0;
    for (auto const& point : problem.attached<Contact>().points()) up += point.stress.y() * point.area;
    CHECK(up == samples::Approx(weight).epsilon(1e-8));
  }
  MESSAGE(refused << " of " << draws << " tried again in smaller steps");
  // The bar is what a footing over a fault may cost, a twentieth.
  CHECK(refused <= draws / 20);
}

TEST_CASE("a footing of a centrifuge's model, or of a thousand times the size, answers as the one of two metres") {
  // Floats at first, and its ground is drawn out and tilted.
  auto const motion = [](auto const& place) -> scarp::Vector<2> {
    return scarp::Vector<2>(1e-2 * place.x(), -0.02 * place.x());
  };
  auto const place_at = [&](double scale, long& iterations) {
    scarp::SerialExecutor executor;
    auto problem = moved_ground(executor, motion, 0.01, scale);
    auto const run = in_one_step(problem, 0.01);
    REQUIRE(run.verdict.acceptable());
    iterations = run.iterations;
    auto const& body = problem.attached<Contact>().body().body();
    return scarp::Vector<3>(body.reference().x() / scale, body.reference().y() / scale, body.rotation());
  };
  long iterations = 0;
  scarp::Vector<3> const usual = place_at(1.0, iterations);
  for (double const scale : {0.01, 1000.0}) {
    CAPTURE(scale);
    long scaled = 0;
    // Every number but angles is the other one times a power of the scale: round-off, magnified by the iterations.
    CHECK((place_at(scale, scaled) - usual).norm() < 1e-12);
    CHECK(scaled == iterations);
  }
}

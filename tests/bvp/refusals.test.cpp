// SPDX-License-Identifier: BSL-1.0
// What this room refuses, and with which names and numbers.
#include "support/refusals.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/following_pressure.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/bvp/standing_body.hpp"
#include "support/approx.hpp"
#include "support/crossed_rectangle.hpp"

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

using Facets = std::vector<scarp::FacetChain::Facet>;

scarp::RigidFooting footing(scarp::Vector<2> const& left, scarp::Vector<2> const& right, double thickness = 1.0) {
  return {{{0.0, 0.0}, 1.0}, left, right, {}, thickness, 8};
}

}  // namespace

TEST_CASE("prescriptions that do not exist or contradict each other are refused") {
  scarp::Constraints constraints(samples::CrossedRectangle{}.generate(), 3);
  CHECK_REFUSED(constraints.move_extra(3, 0.0), "extra degree of freedom 3", "there are 3");
  CHECK_REFUSED(constraints.move_extra(-1, 0.0), "extra degree of freedom -1");
  CHECK_REFUSED(constraints.move_extra(0, not_a_number), "rate of a prescribed displacement", "nan");
  constraints.move_extra(1, 2.0, scarp::TimeFunction::ramp(0.0, 1.0));
  CHECK_REFUSED(constraints.move_extra(1, 2.0, scarp::TimeFunction::ramp(0.0, 2.0)), "extra degree of freedom 1",
                "different amplitudes", "2");
}

TEST_CASE("amplitudes without knots or with knots out of order are refused") {
  using Knots = std::vector<std::pair<double, double>>;
  CHECK_REFUSED(scarp::TimeFunction(Knots{}), "no knots");
  CHECK_REFUSED(scarp::TimeFunction(Knots{{0.0, 1.0}, {0.0, 2.0}}), "knot 1 is at the load factor 0", "before at 0");
  CHECK_REFUSED(scarp::TimeFunction(Knots{{1.0, 0.0}, {0.5, 1.0}}), "knot 1 is at the load factor 0.5", "before at 1");
  CHECK_REFUSED(scarp::TimeFunction(Knots{{not_a_number, 0.0}}), "load factor of a knot", "nan");
  CHECK_REFUSED(scarp::TimeFunction(Knots{{0.0, infinity}}), "value of a knot", "inf");
}

TEST_CASE("loads that are no numbers or have another size are refused") {
  scarp::LoadHistory loads;
  CHECK_REFUSED(loads.add(Eigen::VectorXd::Constant(4, not_a_number), {}), "a load is not finite");
  CHECK_REFUSED(loads.add(Eigen::VectorXd::Constant(4, infinity), {}), "a load is not finite");
}

TEST_CASE("a force per volume is given for each region of the mesh") {
  auto mesh = samples::CrossedRectangle{}.generate();
  mesh.regions = {"sand", "clay"};
  scarp::Discretisation<scarp::Tri3> const grid(mesh);
  using Forces = std::vector<scarp::Vector<2>>;
  CHECK_REFUSED(grid.body_force(Forces(1, {0.0, -1.0})), "for 1 regions", "the mesh has 2", "sand", "clay");
  CHECK_REFUSED(grid.body_force(Forces(3, {0.0, -1.0})), "for 3 regions", "the mesh has 2");
  CHECK(grid.body_force(Forces(2, {0.0, -1.0})).sum() == samples::Approx(-1.0).epsilon(1e-14));
}

TEST_CASE("facets that are none, or one that would count twice, are refused") {
  CHECK_REFUSED(scarp::FacetChain(Facets{}), "a chain of facets", "no facets");
  CHECK_REFUSED(scarp::FacetChain(Facets{{0, 1}, {1, 2}, {0, 1}}), "a chain of facets", "(0, 1) twice");
  CHECK_REFUSED(scarp::FacetChain(Facets{{3, 1}, {1, 3}}), "(1, 3) twice");
  CHECK_REFUSED(scarp::FacetChain(Facets{{0, 1}, {-1, 2}}), "node -1", "count from 0");
  scarp::FollowingPressure<> const beyond(Facets{{0, 1}, {1, 9}}, 1e5);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(18);
  CHECK_REFUSED(beyond.add_forces(std::vector<scarp::Vector<2>>(9, {0.0, 0.0}), forces, forces), "node 9",
                "the mesh has 9");
  CHECK_REFUSED(scarp::FollowingPressure<>(Facets{}, 1e5), "a following pressure", "no facets");
  CHECK_REFUSED(scarp::FollowingPressure<>(Facets{{0, 1}, {1, 2}, {2, 1}}, 1e5), "a following pressure",
                "(1, 2) twice");
  CHECK_REFUSED(scarp::FollowingPressure<>(Facets{{0, 1}}, not_a_number), "pressure is nan");
  CHECK_REFUSED(scarp::FollowingPressure<>(Facets{{0, 1}}, 1e5, 0.0), "thickness is 0");
}

TEST_CASE("a rigid footing has a base from left to right, an arm and a thickness") {
  CHECK_REFUSED(footing({1.0, 0.0}, {-1.0, 0.0}), "from (1 m, 0 m) to (-1 m, 0 m)", "left to right");
  CHECK_REFUSED(footing({1.0, 0.0}, {1.0, 2.0}), "from (1 m, 0 m) to (1 m, 2 m)");
  CHECK_REFUSED(footing({not_a_number, 0.0}, {1.0, 0.0}), "from (nan m, 0 m)");
  CHECK_REFUSED(footing({-1.0, 0.0}, {1.0, infinity}), "inf m");
  CHECK_REFUSED(footing({-1.0, 0.0}, {1.0, 0.0}, -1.0), "thickness is -1");
  for (double const arm : {0.0, -1.0, not_a_number}) CHECK_REFUSED(scarp::RigidBody({0.0, 0.0}, arm), "arm is");
  CHECK(footing({-1.0, 0.0}, {1.0, 0.0}).length() == 2.0);
}

TEST_CASE("a footing of the mesh has a thickness and no upright facets") {
  std::vector<scarp::Vector<2>> const nodes{{0.0, 1.0}, {1.0, 1.0}, {1.0, 0.5}};
  scarp::FacetChain const level({{0, 1}});
  CHECK_REFUSED(scarp::MeshedFooting(level, {}, nodes, -1.0), "thickness is -1");
  CHECK(scarp::MeshedFooting(level, {}, nodes, 2.0).thickness() == 2.0);
  CHECK_REFUSED(scarp::MeshedFooting(scarp::FacetChain({{0, 1}, {1, 2}}), {}, nodes, 1.0),
                "upright facet at (1 m, 1 m)");
}

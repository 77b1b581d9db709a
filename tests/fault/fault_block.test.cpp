// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/fault_block.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/fault/fault_mesh.hpp"

namespace {

constexpr double degree = std::numbers::pi / 180.0;

}  // namespace

TEST_CASE("the hanging wall slides down the fault plane and the foot wall stays") {
  auto const mesh = scarp::FaultMesh{.tip = -3.0, .size = 2.5}.generate();
  scarp::FaultBlock const fault{.dip = 60.0 * degree, .tip = -3.0};
  auto const constraints = fault.constraints(mesh);
  auto const moves = constraints.displacement(0.4);
  int moving = 0;
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n) {
    auto const& place = mesh.nodes[static_cast<std::size_t>(n)];
    bool const outer = place.x() == -52.0 || place.x() == 23.0 || place.y() == 0.0;
    bool const hanging = place.x() == 23.0 || (place.y() == 0.0 && place.x() > -3.0);
    CHECK(constraints.is_prescribed(2 * n) == outer);
    CHECK(constraints.is_prescribed(2 * n + 1) == outer);
    // Analytic: throw 0.4 m, heave 0.4/tan(60 deg) = 0.4/sqrt(3).
    scarp::Vector<2> const expected =
        hanging ? scarp::Vector<2>(0.4 / std::sqrt(3.0), -0.4) : scarp::Vector<2>(0.0, 0.0);
    CHECK((moves.segment<2>(2 * n) - expected).norm() < 1e-15);
    moving += hanging ? 1 : 0;
  }
  CHECK(moving > 10);
}

TEST_CASE("the node on the kink belongs to the foot wall") {
  auto const mesh = scarp::FaultMesh{.tip = 10.0 / 3.0, .size = 2.5}.generate();
  auto const moves = scarp::FaultBlock{.dip = 1.0, .tip = 10.0 / 3.0}.constraints(mesh).displacement(1.0);
  int found = 0;
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) {
    if (mesh.nodes[static_cast<std::size_t>(node)].x() == 10.0 / 3.0) {
      CHECK(moves.segment<2>(2 * node).isZero(0.0));
      ++found;
    }
  }
  CHECK(found == 1);
}

TEST_CASE("a vertical fault moves exactly vertically") {
  CHECK(scarp::FaultBlock{.dip = 90.0 * degree}.heave() == 0.0);
  auto const mesh = scarp::FaultMesh{.size = 4.0}.generate();
  auto const moves = scarp::FaultBlock{.dip = 90.0 * degree}.constraints(mesh).displacement(2.0);
  for (Eigen::Index dof = 0; dof < moves.size(); dof += 2) {
    CHECK(moves(dof) == 0.0);
  }
  CHECK(moves.minCoeff() == -2.0);
}

TEST_CASE("a dip out of range is refused, with a hint when it looks like degrees") {
  auto const mesh = scarp::FaultMesh{.size = 4.0}.generate();
  for (double const dip : {0.0, -0.5, 1.6, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(scarp::FaultBlock{.dip = dip}.constraints(mesh), scarp::InputError);
  }
  CHECK_THROWS_WITH_AS(
      scarp::FaultBlock{.dip = 60.0}.constraints(mesh),
      "the dip is 60 rad (a normal fault dips by more than 0 and at most pi/2): was it given in degrees?",
      scarp::InputError);
}

TEST_CASE("a tip outside the bottom is refused") {
  auto const mesh = scarp::FaultMesh{.size = 4.0}.generate();
  for (double const tip : {-52.0, 23.0, 100.0, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS((scarp::FaultBlock{.tip = tip}.constraints(mesh)), scarp::InputError);
  }
}

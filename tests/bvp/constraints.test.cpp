// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/constraints.hpp"
#include "support/crossed_rectangle.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "support/refusals.hpp"

namespace {

scarp::Constraints on_square() { return scarp::Constraints(samples::CrossedRectangle{}.generate()); }  // five nodes

}  // namespace

TEST_CASE("prescribed degrees of freedom come sorted with their rates, whatever the order of the calls") {
  auto constraints = on_square();
  constraints.move(3, 1, -1.0);
  constraints.fix(0);
  constraints.move(1, 0, 0.5);
  CHECK(constraints.prescribed_dofs() == std::vector<int>{0, 1, 2, 7});
  CHECK(constraints.rate(2) == 0.5);
  CHECK(constraints.rate(7) == -1.0);
  CHECK(constraints.rate(3) == 0.0);
}

TEST_CASE("free degrees of freedom are numbered without gaps") {
  auto constraints = on_square();
  constraints.fix(0, 1);
  constraints.fix(2, 0);
  auto const free = constraints.free_dofs();
  CHECK(free == std::vector<int>{0, 2, 3, 5, 6, 7, 8, 9});
  CHECK(constraints.free_count() == 8);
  CHECK(constraints.is_prescribed(4));
  CHECK_FALSE(constraints.is_prescribed(5));
}

TEST_CASE("displacements follow the load factor") {
  auto constraints = on_square();
  constraints.move(1, 1, -2.0);
  constraints.fix(0, 0);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(10);
  expected(3) = -0.5;
  CHECK(constraints.displacement(0.25) == expected);
}

TEST_CASE("the next knot is the nearest beyond a load factor, of all motions and loads") {
  auto constraints = on_square();
  double const never = std::numeric_limits<double>::infinity();
  constraints.fix(0);
  constraints.move(1, 0, 2.0);
  CHECK(constraints.next_knot(-1.0) == never);
  constraints.move(2, 0, 1.0, scarp::TimeFunction({{-0.5, 0.0}, {0.7, 1.0}, {0.9, 0.0}}));
  constraints.move(3, 0, 1.0, scarp::TimeFunction::after(0.8));
  CHECK(constraints.next_knot(-1.0) == -0.5);
  CHECK(constraints.next_knot(-0.5) == 0.7);
  CHECK(constraints.next_knot(0.7) == 0.8);
  CHECK(constraints.next_knot(0.9) == never);
  scarp::LoadHistory loads(Eigen::VectorXd::Zero(10));
  loads.add(Eigen::VectorXd::Ones(10), scarp::TimeFunction::ramp(0.2, 0.6));
  CHECK(loads.next_knot(0.2) == 0.6);
  CHECK(loads.next_knot(0.6) == never);
}

TEST_CASE("the same prescription twice is one, two different ones are refused") {
  auto constraints = on_square();
  constraints.move(1, 0, 0.5);
  CHECK_NOTHROW(constraints.move(1, 0, 0.5));
  CHECK(constraints.prescribed_dofs().size() == 1);
  CHECK_REFUSED(constraints.fix(1, 0), "node 1, axis 0 ", "0.5 and 0 ");
  CHECK(constraints.rate(2) == 0.5);
}

TEST_CASE("nodes, axes and rates that do not exist are refused") {
  auto constraints = on_square();
  CHECK_REFUSED(constraints.fix(5, 0), "node 5, axis 0", "0 to 4");
  CHECK_REFUSED(constraints.fix(-1, 0), "node -1, axis 0");
  CHECK_REFUSED(constraints.fix(0, 2), "node 0, axis 2", "0 to 1");
  CHECK_REFUSED(constraints.move(0, 0, std::numeric_limits<double>::quiet_NaN()), "rate", "nan");
}

TEST_CASE("a node that cannot be held along one axis is held along none") {
  auto constraints = on_square();
  constraints.move(0, 1, 0.5);
  CHECK_REFUSED(constraints.fix(0), "node 0, axis 1 is prescribed twice");
  CHECK_FALSE(constraints.is_prescribed(0));
}

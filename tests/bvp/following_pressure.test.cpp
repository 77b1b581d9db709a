// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/following_pressure.hpp"

#include <doctest/doctest.h>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/core/random.hpp"
#include "scarp/element/line.hpp"
#include "scarp/solver/make_problem.hpp"
#include "support/crossed_rectangle.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Line2;
using scarp::Line3;
using scarp::Vector;

constexpr double pressure = 3e5;   // [Pa]
constexpr double thickness = 0.2;  // [m]

/// Nodes anywhere in the unit square, moved by increments of half its size: nothing is nearly flat or small.
struct Outline {
  explicit Outline(int count) : increment(2 * count) {
    scarp::Random random(11);
    for (int n = 0; n < count; ++n) nodes.emplace_back(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
    for (auto& entry : increment) entry = random.uniform(-0.5, 0.5);
  }

  template <class Pressure>
  Eigen::VectorXd forces(Pressure const& lateral) const {
    return forces(lateral, increment);
  }
  template <class Pressure>
  Eigen::VectorXd forces(Pressure const& lateral, Eigen::VectorXd const& at) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(at.size());
    CHECK(lateral.add_forces(nodes, at, sum).acceptable());
    return sum;
  }
  Vector<2> place(int node) const { return nodes[static_cast<std::size_t>(node)] + increment.segment<2>(2 * node); }

  std::vector<Vector<2>> nodes;
  Eigen::VectorXd increment;
};

Vector<2> resultant(Eigen::VectorXd const& forces) { return forces.reshaped(2, forces.size() / 2).rowwise().sum(); }

/// Of the internal forces about the origin, positive counter-clockwise.
double moment(Outline const& outline, Eigen::VectorXd const& forces) {
  double sum = 0.0;
  for (int n = 0; n < static_cast<int>(outline.nodes.size()); ++n) {
    Vector<2> const at = outline.place(n);
    sum += at.x() * forces(2 * n + 1) - at.y() * forces(2 * n);
  }
  return sum;
}

constexpr double round_off = 1e-14 * pressure * thickness;  // of a few dozen sums of lengths of about one

}  // namespace

TEST_CASE("Pressure on a closed outline has neither resultant nor moment, straight or curved") {
  Outline const outline(6);
  scarp::FollowingPressure<Line2> const straight({{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 0}}, pressure, thickness);
  scarp::FollowingPressure<Line3> const curved({{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}, pressure, thickness);
  for (Eigen::VectorXd const& forces : {outline.forces(straight), outline.forces(curved)}) {
    CHECK(forces.norm() > 0.1 * pressure * thickness);
    CHECK(resultant(forces).norm() < 10.0 * round_off);
    CHECK(std::abs(moment(outline, forces)) < 10.0 * round_off);
  }
}

TEST_CASE("Pressure on a part of an outline adds up to pressure times projected length, pushing into the body") {
  Outline const outline(5);
  scarp::FollowingPressure<Line2> const straight({{0, 1}, {1, 2}}, pressure, thickness);
  scarp::FollowingPressure<Line3> const curved({{0, 1, 3}, {1, 2, 4}}, pressure, thickness);
  Vector<2> const chord = outline.place(2) - outline.place(0);
  // Internal forces hold against the load, which is p t (-dy, dx) with the body on the left of the chord.
  Vector<2> const expected = pressure * thickness * Vector<2>(chord.y(), -chord.x());
  CHECK((resultant(outline.forces(straight)) - expected).norm() < 10.0 * round_off);
  CHECK((resultant(outline.forces(curved)) - expected).norm() < 10.0 * round_off);
}

TEST_CASE("Nodes of a straight quadratic facet carry a sixth, a sixth and two thirds") {
  std::vector<Vector<2>> const nodes{{1.0, 0.0}, {1.0, 2.0}, {1.0, 1.0}};
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(6);
  scarp::FollowingPressure<Line3> const load({{0, 1, 2}}, pressure, thickness);
  REQUIRE(load.add_forces(nodes, Eigen::VectorXd::Zero(6), forces).acceptable());
  double const total = 2.0 * pressure * thickness;
  Eigen::VectorXd expected(6);
  expected << total / 6.0, 0.0, total / 6.0, 0.0, total * 2.0 / 3.0, 0.0;
  CHECK((forces - expected).norm() < round_off);
}

TEST_CASE("The stiffness of a pressure that follows is the derivative of its forces") {
  Outline const outline(5);
  auto const check = [&](auto const& lateral) {
    std::vector<Eigen::Triplet<double>> entries;
    lateral.add_stiffness(entries);
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(10, 10);
    for (auto const& entry : entries) stiffness(entry.row(), entry.col()) += entry.value();
    Eigen::MatrixXd slopes(10, 10);  // forces are linear: any step gives them exactly
    for (int dof = 0; dof < 10; ++dof) {
      Eigen::VectorXd const further = outline.increment + Eigen::VectorXd::Unit(10, dof);
      slopes.col(dof) = outline.forces(lateral, further) - outline.forces(lateral);
    }
    CHECK(stiffness.norm() > 0.1 * pressure * thickness);
    CHECK((stiffness - slopes).norm() < 100.0 * round_off);
  };
  check(scarp::FollowingPressure<Line2>({{0, 1}, {1, 2}}, pressure, thickness));
  check(scarp::FollowingPressure<Line3>({{0, 1, 3}, {1, 2, 4}}, pressure, thickness));
}

TEST_CASE("A pressure that is not finite and a thickness of zero are refused") {
  using Lateral = scarp::FollowingPressure<>;
  CHECK_REFUSED(Lateral({{0, 1}}, std::nan(""), 1.0), "pressure is nan");
  CHECK_REFUSED(Lateral({{0, 1}}, 1.0, 0.0), "thickness is 0");
}

TEST_CASE("A pressure on a mesh of another thickness is refused") {
  scarp::SerialExecutor serial;
  auto const made = [&](double of_mesh, double of_pressure) {
    scarp::Discretisation<scarp::Tri3> grid(samples::CrossedRectangle{.columns = 1, .rows = 1}.generate(), of_mesh);
    scarp::Constraints constraints(grid.mesh());
    auto const region = grid.mesh().regions.front();
    return scarp::make_problem(
        std::move(grid), 1.0,
        boost::hana::make_tuple(scarp::Region{region, scarp::LinearElastic<2>::from_young_poisson(1e6, 0.3)}),
        std::move(constraints), scarp::LoadHistory(), serial, scarp::FollowingPressure<>({{0, 1}}, 1e3, of_pressure));
  };
  CHECK_REFUSED(made(0.2, 1.0), "1 m thick", "0.2 m");
  CHECK_NOTHROW(made(0.2, 0.2));
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/dip_slip_faults.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/element/quad8.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/fault/ground.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

/// A normal fault whose left side takes a quarter of the slip, the other way.
struct SharedSlip : scarp::NormalFault {
  scarp::Vector<2> left() const { return -0.25 * NormalFault::right(); }
  scarp::Vector<2> right() const { return 0.75 * NormalFault::right(); }
};

constexpr double degree = std::numbers::pi / 180.0;

/// 8 m x 2 m in cells of 1 m; stretch moves the lines right of x = 3 m away from each other.
template <class Element = scarp::Tri3>
scarp::Mesh<Element> ground(double stretch = 1.0) {
  return scarp::BoxMesh<Element>{.lengths = {8.0, 2.0},
                                 .cells = {8, 2},
                                 .map =
                                     [=](scarp::Vector<2> const& place) {
                                       double const beyond = std::max(place.x() - 3.0, 0.0);
                                       return scarp::Vector<2>(place.x() + (stretch - 1.0) * beyond, place.y());
                                     }}
      .generate();
}

/// Integral over the bottom of the vertical displacement per throw times (x - tip)^power.
template <class Element>
double moment(scarp::Mesh<Element> const& mesh, scarp::NormalFault const& fault, int power) {
  using Facet = typename Element::Facet;
  auto const moves = scarp::bedrock_constraints(mesh, fault).displacement(1.0);
  // Gauss: exact to degree 5 on [0, 1].
  std::array<std::pair<double, double>, 3> const gauss{
      {{0.5 - std::sqrt(0.15), 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + std::sqrt(0.15), 5.0 / 18.0}}};
  double sum = 0.0;
  for (auto const& facet : scarp::boundary(mesh, "bottom")) {
    auto const rows = scarp::corners<Facet, 2>(facet, mesh.nodes);
    for (auto const& [at, weight] : gauss) {
      scarp::Vector<1> const xi(at);
      auto const shape = Facet::shape(xi);
      double down = 0.0;
      for (int a = 0; a < Facet::nodes; ++a) down -= shape(a) * moves(2 * facet[static_cast<std::size_t>(a)] + 1);
      double const x = (rows.transpose() * shape)(0) - fault.tip;
      sum += weight * scarp::measure<Facet, 2>(rows, xi) * down * std::pow(x, power);
    }
  }
  return sum;
}

/// The same of a step from 0 to 1 at the tip: analytic.
double moment_of_step(double reach, int power) { return std::pow(reach, power + 1) / (power + 1); }

}  // namespace

TEST_CASE("the hanging wall slides down the fault plane, the footwall stays, and both share the node at the tip") {
  auto const mesh = ground();
  auto const constraints = scarp::bedrock_constraints(mesh, scarp::NormalFault{.dip = 60.0 * degree, .tip = 3.0});
  auto const moves = constraints.displacement(0.4);
  int moving = 0;
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n) {
    auto const& place = mesh.nodes[static_cast<std::size_t>(n)];
    bool const outer = place.x() == 0.0 || place.x() == 8.0 || place.y() == 0.0;
    bool const hanging = place.x() == 8.0 || (place.y() == 0.0 && place.x() > 3.0);
    bool const at_tip = place.y() == 0.0 && place.x() == 3.0;
    CHECK(constraints.is_prescribed(2 * n) == outer);
    CHECK(constraints.is_prescribed(2 * n + 1) == outer);
    // Analytic: throw 0.4 m, heave 0.4/tan(60 deg) = 0.4/sqrt(3).
    double const share = hanging ? 1.0 : at_tip ? 0.5 : 0.0;
    scarp::Vector<2> const expected = share * scarp::Vector<2>(0.4 / std::sqrt(3.0), -0.4);
    CHECK((moves.segment<2>(2 * n) - expected).norm() < 1e-15);
    moving += hanging ? 1 : 0;
  }
  CHECK(moving > 5);
}

TEST_CASE("the step that the bottom takes has the moments of a step at the tip, on unequal facets as well") {
  constexpr double round_off = 1e-13;
  for (double const stretch : {1.0, 1.6}) {
    scarp::NormalFault const fault{.tip = 3.0};
    double const reach = 5.0 * stretch;
    CHECK(moment(ground<scarp::Tri3>(stretch), fault, 0) ==
          samples::Approx(moment_of_step(reach, 0)).epsilon(round_off));
    for (int const power : {0, 1, 2}) {
      CHECK(moment(ground<scarp::Tri6>(stretch), fault, power) ==
            samples::Approx(moment_of_step(reach, power)).epsilon(round_off));
      CHECK(moment(ground<scarp::Quad8>(stretch), fault, power) ==
            samples::Approx(moment_of_step(reach, power)).epsilon(round_off));
    }
  }
}

TEST_CASE("a tip between two lines of nodes is felt where it is") {
  for (double const tip : {2.25, 2.5, 4.9}) {
    scarp::NormalFault const fault{.tip = tip};
    CHECK(moment(ground<scarp::Tri3>(), fault, 0) == samples::Approx(8.0 - tip).epsilon(1e-13));
    CHECK(moment(ground<scarp::Quad8>(), fault, 0) == samples::Approx(8.0 - tip).epsilon(1e-13));
  }
}

TEST_CASE("in space the step is that of the plane and nothing moves along the strike") {
  auto const mesh = scarp::BoxMesh<scarp::Tet10>{.lengths = {8.0, 1.0, 2.0}, .cells = {8, 1, 2}}.generate();
  auto const constraints = scarp::bedrock_constraints(mesh, scarp::NormalFault{.tip = 3.0});
  auto const moves = constraints.displacement(1.0);
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n) {
    auto const& place = mesh.nodes[static_cast<std::size_t>(n)];
    if (place.y() == 0.0 || place.y() == 1.0) CHECK(constraints.is_prescribed(3 * n + 1));
    if (place.z() > 0.0 && place.x() > 0.0 && place.x() < 8.0) continue;
    // Analytic: quadratic facets of one length take 0, 0, 1/2, 1, 1 (see the moments above).
    double const share = place.x() < 2.75 ? 0.0 : place.x() > 3.25 ? 1.0 : 0.5;
    CHECK(moves(3 * n + 2) == samples::Approx(-share).epsilon(1e-13));
    CHECK(moves(3 * n + 1) == 0.0);
  }
}

TEST_CASE("a reverse fault is the normal one backwards, and slip may be shared by both sides") {
  scarp::NormalFault const normal{.dip = 0.9, .tip = 3.0};
  auto const mesh = ground();
  auto const moves = scarp::bedrock_constraints(mesh, normal).displacement(1.0);
  auto const back = scarp::bedrock_constraints(mesh, scarp::ReverseFault{.dip = 0.9, .tip = 3.0}).displacement(1.0);
  CHECK((moves + back).norm() < 1e-15);
  SharedSlip const shared{normal};
  auto const offset = scarp::offset_at(shared, 2.0);
  CHECK(offset.tip == 3.0);
  CHECK(offset.foot == samples::Approx(-0.5).epsilon(1e-15));
  CHECK(offset.hanging == samples::Approx(1.5).epsilon(1e-15));
  CHECK(scarp::offset_at(scarp::ReverseFault{}, 2.0).hanging == -2.0);
}

TEST_CASE("a fault that is given no tip meets the ground at zero") {
  CHECK(scarp::offset_at(scarp::ReverseFault{}, 2.0).tip == 0.0);
  CHECK(scarp::offset_at(scarp::NormalFault{}, 2.0).tip == 0.0);
}

TEST_CASE("a node at the tip is told by the length of the bottom, wherever that lies") {
  auto mesh = ground();
  for (auto& node : mesh.nodes) node.x() -= 4.0;
  CHECK_NOTHROW(scarp::require_node_at_tip(mesh, 4e-6));  // half of a millionth of 8 m
  CHECK_REFUSED(scarp::require_node_at_tip(mesh, 1.6e-5), "tip is at x = 1.6e-05");
}

TEST_CASE("a vertical fault moves exactly vertically") {
  auto const mesh = ground();
  auto const moves =
      scarp::bedrock_constraints(mesh, scarp::NormalFault{.dip = 90.0 * degree, .tip = 3.0}).displacement(2.0);
  for (Eigen::Index dof = 0; dof < moves.size(); dof += 2) {
    CHECK(moves(dof) == 0.0);
  }
  CHECK(moves.minCoeff() == -2.0);
}

TEST_CASE("a dip out of range is refused, with a hint when it looks like degrees") {
  for (double const dip : {0.0, -0.5, 1.6, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_REFUSED(scarp::NormalFault{.dip = dip}.right(), fmt::format("dip is {}", dip));
    CHECK_REFUSED(scarp::ReverseFault{.dip = dip}.right(), fmt::format("dip is {}", dip));
  }
  CHECK_REFUSED(scarp::NormalFault{.dip = 60.0}.right(), "dip is 60 rad", "degrees");
}

TEST_CASE("a tip outside the bottom, in its outermost facets or, where a node is requested, beside one is refused") {
  auto const mesh = ground();
  for (double const tip : {0.0, 8.0, 0.5, 7.5, 100.0, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_REFUSED(scarp::bedrock_constraints(mesh, scarp::NormalFault{.tip = tip}),
                  fmt::format("tip is at x = {}", tip));
  }
  CHECK_NOTHROW(scarp::require_node_at_tip(mesh, 3.0));
  CHECK_REFUSED(scarp::require_node_at_tip(mesh, 3.25), "tip is at x = 3.25 m", "3 m");
}

TEST_CASE("a fault without a bottom to meet, and a mesh without the sides that move, are refused") {
  auto mesh = ground();
  mesh.boundaries["bottom"].clear();
  CHECK_REFUSED(scarp::bedrock_constraints(mesh, scarp::NormalFault{.tip = 3.0}),
                "the boundary 'bottom' has no facets");
  CHECK_REFUSED(scarp::require_node_at_tip(mesh, 3.0), "the boundary 'bottom' has no facets");
  CHECK_REFUSED(scarp::bottom_level(mesh), "the boundary 'bottom' has no facets");
  mesh = ground();
  mesh.boundaries.erase("left");
  CHECK_REFUSED(scarp::bedrock_constraints(mesh, scarp::NormalFault{.tip = 3.0}), "there is no boundary 'left'");
}

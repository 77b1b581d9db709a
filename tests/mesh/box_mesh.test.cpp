// SPDX-License-Identifier: BSL-1.0
#include "scarp/mesh/box_mesh.hpp"

#include <doctest/doctest.h>
#include <Eigen/Geometry>

#include <limits>
#include <numbers>

#include "scarp/element/hex20.hpp"
#include "scarp/element/tet10.hpp"
#include "support/approx.hpp"
#include "support/crossed_rectangle.hpp"
#include "support/elements.hpp"
#include "support/refusals.hpp"

namespace {

template <int Dim>
scarp::Vector<Dim> lengths() {
  return scarp::Vector<Dim>::LinSpaced(1.5, 0.7);
}

template <class Element>
scarp::BoxMesh<Element> distorted_box() {
  auto cells = scarp::BoxMesh<Element>::filled(3);
  cells[0] = 2;
  return {.lengths = lengths<Element::dim>(), .cells = cells, .distortion = 0.2, .seed = 7};
}

/// Area and resultant of the outward normals of a boundary.
template <class Element>
std::pair<double, scarp::Vector<Element::dim>> area(scarp::Mesh<Element> const& mesh, std::string const& name) {
  using Facet = typename Element::Facet;
  constexpr int dim = Element::dim;
  double sum = 0.0;
  scarp::Vector<dim> normals = scarp::Vector<dim>::Zero();
  for (auto const& facet : scarp::boundary(mesh, name)) {
    auto const rows = scarp::corners<Facet, dim>(facet, mesh.nodes);
    for (auto const& point : Facet::quadrature()) {
      sum += point.weight * scarp::measure<Facet, dim>(rows, point.xi);
      auto const along = scarp::jacobian<Facet, dim>(rows, point.xi);
      scarp::Vector<dim> normal;
      if constexpr (dim == 2) {
        normal << along(1, 0), -along(0, 0);
      } else {
        normal = scarp::Vector<3>(along.col(0)).cross(scarp::Vector<3>(along.col(1)));
      }
      normals += point.weight * normal;
    }
  }
  return {sum, normals};
}

}  // namespace

TEST_CASE_TEMPLATE("a distorted box is filled once and has its sides with outward normals", Element, SAMPLE_ELEMENTS) {
  constexpr int dim = Element::dim;
  auto const mesh = distorted_box<Element>().generate();
  double const whole = lengths<dim>().prod();
  CHECK(scarp::region_area(mesh, "soil", mesh.nodes) ==
        samples::Approx(whole).epsilon(1e-14));  // analytic; round-off of some hundred terms
  constexpr char const* names[3][2] = {
      {"left", "right"}, {dim == 2 ? "bottom" : "front", dim == 2 ? "top" : "back"}, {"bottom", "top"}};
  CHECK(mesh.boundaries.size() == 2 * dim);
  for (int axis = 0; axis < dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      auto const [size, normals] = area(mesh, names[axis][side]);
      double const expected = whole / lengths<dim>()(axis);  // analytic
      CHECK(size == samples::Approx(expected).epsilon(1e-14));
      CHECK((normals - (2 * side - 1) * expected * scarp::Vector<dim>::Unit(axis)).norm() < 1e-14);
      for (int const node : scarp::boundary_nodes(mesh, names[axis][side])) {
        CHECK(mesh.nodes[static_cast<std::size_t>(node)](axis) == side * lengths<dim>()(axis));
      }
    }
  }
}

TEST_CASE_TEMPLATE("neighbours share all nodes of their common side", Element, SAMPLE_ELEMENTS) {
  auto const mesh = distorted_box<Element>().generate();
  std::map<std::array<int, Element::facet_nodes>, int> uses;
  for (auto const& element : mesh.elements) {
    for (auto facet : Element::facets()) {
      for (int& node : facet) {
        node = element[static_cast<std::size_t>(node)];
      }
      std::sort(facet.begin(), facet.end());
      ++uses[facet];
    }
  }
  std::size_t outer = 0;
  for (auto const& [facet, times] : uses) {
    CHECK(times <= 2);
    outer += times == 1 ? 1 : 0;
  }
  std::size_t named = 0;
  for (auto const& [name, facets] : mesh.boundaries) {
    named += facets.size();
  }
  CHECK(outer == named);  // a side that only one element has lies on the box
}

TEST_CASE("numbers of nodes and elements are those of the grid") {
  // Analytic, 2 x 3 (x 3) cells: corners 3 * 4 (* 4); edges of squares 2 * 4 + 3 * 3 = 17, of cubes 2*4*4 + 3*3*4 +
  // 3*4*3 = 104; diagonals one per square: 6; of cubes one per face (2*3*4 + 2*4*3 + 3*3*3 = 75) and one per cell (18).
  auto const size = [](auto const& mesh) { return std::pair(mesh.nodes.size(), mesh.elements.size()); };
  using Pair = std::pair<std::size_t, std::size_t>;
  CHECK(size(distorted_box<scarp::Tri3>().generate()) == Pair(12, 12));
  CHECK(size(distorted_box<scarp::Tri6>().generate()) == Pair(12 + 17 + 6, 12));
  CHECK(size(distorted_box<scarp::Quad4>().generate()) == Pair(12, 6));
  CHECK(size(distorted_box<scarp::Quad8>().generate()) == Pair(12 + 17, 6));
  CHECK(size(distorted_box<scarp::Tet4>().generate()) == Pair(48, 108));
  CHECK(size(distorted_box<scarp::Tet10>().generate()) == Pair(48 + 104 + 75 + 18, 108));
  CHECK(size(distorted_box<scarp::Hex8>().generate()) == Pair(48, 18));
  CHECK(size(distorted_box<scarp::Hex20>().generate()) == Pair(48 + 104, 18));
}

TEST_CASE_TEMPLATE("a map to a ring sector bends quadratic sides", Element, scarp::Tri6, scarp::Quad8) {
  auto const ring = [](scarp::Vector<2> const& box) -> scarp::Vector<2> {
    double const radius = 1.0 + box.y();
    double const angle = std::numbers::pi / 2.0 * (1.0 - box.x());
    return radius * scarp::Vector<2>(std::cos(angle), std::sin(angle));
  };
  auto const mesh = scarp::BoxMesh<Element>{.cells = {8, 4}, .map = ring}.generate();
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) {
    CHECK(mesh.nodes[static_cast<std::size_t>(node)].norm() == samples::Approx(1.0).epsilon(1e-15));
  }
  // Analytic: 3 pi / 4. A chord of half-angle a = pi/32 with its middle on the circle is off by about a^4/30 = 3e-6 of
  // the length; straight sides would be off by a^2/6 = 2e-3.
  CHECK(scarp::region_area(mesh, "soil", mesh.nodes) == samples::Approx(0.75 * std::numbers::pi).epsilon(1e-5));
}

TEST_CASE("a mesh of straight triangles gets nodes on its edges and keeps its boundaries") {
  auto const linear = samples::CrossedRectangle{.columns = 2, .rows = 1}.generate();
  auto const mesh = scarp::with_nodes_of<scarp::Tri6>(linear);
  CHECK_NOTHROW(scarp::validate(mesh));
  CHECK(mesh.nodes.size() == linear.nodes.size() + 15);  // counted: 7 sides of cells, 8 half diagonals
  for (auto const& [name, facets] : linear.boundaries) {
    auto const& quadratic = scarp::boundary(mesh, name);
    REQUIRE(quadratic.size() == facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
      CHECK(std::equal(facets[f].begin(), facets[f].end(), quadratic[f].begin()));
      auto const at = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
      CHECK(at(quadratic[f][2]) == scarp::Vector<2>((at(facets[f][0]) + at(facets[f][1])) / 2.0));
    }
  }
}

TEST_CASE("boxes that cannot be are refused") {
  using Box = scarp::BoxMesh<scarp::Quad4>;
  double const nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_REFUSED((Box{.lengths = {1.0, 0.0}}.generate()), "length", "is 0");
  CHECK_REFUSED((Box{.lengths = {nan, 1.0}}.generate()), "length", "is nan");
  CHECK_REFUSED((Box{.cells = {0, 1}}.generate()), "0 cells along axis 0");
  CHECK_REFUSED((Box{.distortion = 0.3}.generate()), "distortion is 0.3");
  auto const mirror = [](scarp::Vector<2> const& box) -> scarp::Vector<2> { return {-box.x(), box.y()}; };
  CHECK_REFUSED((Box{.map = mirror}.generate()), "Jacobian -");
}

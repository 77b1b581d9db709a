// SPDX-License-Identifier: BSL-1.0
#include "scarp/mesh/mesh_checks.hpp"

#include <doctest/doctest.h>

#include "support/elements.hpp"
#include "support/refusals.hpp"

#include "scarp/element/hex20.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/mesh/joined_meshes.hpp"

namespace {

/// A unit box of so many cells along each axis, moved along the first.
template <class Element>
scarp::Mesh<Element> box(int cells, double shift) {
  using Place = scarp::Vector<Element::dim>;
  return scarp::BoxMesh<Element>{.cells = scarp::BoxMesh<Element>::filled(cells),
                                 .map = [shift](Place const& place) -> Place { return place + shift * Place::Unit(0); }}
      .generate();
}

/// The part's nodes and elements beside those of the mesh, nothing shared.
template <class Element>
scarp::Mesh<Element> beside(scarp::Mesh<Element> mesh, scarp::Mesh<Element> const& part) {
  int const shift = static_cast<int>(mesh.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), part.nodes.begin(), part.nodes.end());
  for (auto element : part.elements) {
    for (int& node : element) node += shift;
    mesh.elements.push_back(element);
    mesh.element_region.push_back(0);
  }
  return mesh;
}

}  // namespace

TEST_CASE_TEMPLATE("a sound mesh passes all checks", Element, SAMPLE_ELEMENTS) {
  auto mesh = box<Element>(3, 0.0);
  scarp::join(mesh, box<Element>(3, 1.0));
  CHECK_NOTHROW(scarp::require_no_duplicate_nodes(mesh));
  CHECK_NOTHROW(scarp::require_no_hanging_nodes(mesh));
}

TEST_CASE_TEMPLATE("a sound mesh of ten kilometres passes all checks", Element, SAMPLE_ELEMENTS) {
  auto mesh = box<Element>(3, 0.0);
  for (auto& node : mesh.nodes) node *= 1e4;
  CHECK_NOTHROW(scarp::require_no_duplicate_nodes(mesh));
  CHECK_NOTHROW(scarp::require_no_hanging_nodes(mesh));
}

TEST_CASE("the extent of nodes reaches to all sides of the first") {
  CHECK(scarp::extent<2>({{1.0, 0.0}, {0.0, 0.5}, {3.0, -0.5}}) == 3.0);
  CHECK(scarp::extent<2>({{1.0, 0.0}, {0.0, 0.5}, {1.5, -2.0}}) == 2.5);
}

TEST_CASE("the first node counts among those at one place") {
  auto mesh = box<scarp::Tri3>(1, 0.0);
  mesh.nodes.push_back(mesh.nodes.front());
  CHECK_THROWS_WITH_AS(scarp::require_no_duplicate_nodes(mesh), doctest::Contains("nodes 0 and 4 are both"),
                       scarp::InputError);
}

TEST_CASE_TEMPLATE("the outer sides are those of the box", Element, SAMPLE_ELEMENTS) {
  auto const mesh = box<Element>(3, 0.0);
  std::size_t named = 0;
  for (auto const& [name, facets] : mesh.boundaries) named += facets.size();
  auto const sides = scarp::outer_facets(mesh);
  CHECK(sides.size() == named);
  for (auto const& side : sides) {
    auto const& nodes = mesh.elements[static_cast<std::size_t>(side.element)];
    for (int const node : side.nodes) CHECK(std::find(nodes.begin(), nodes.end(), node) != nodes.end());
  }
}

TEST_CASE_TEMPLATE("two nodes at one place are named with it", Element, SAMPLE_ELEMENTS) {
  auto const torn = beside(box<Element>(2, 0.0), box<Element>(2, 1.0));
  CHECK_NOTHROW(scarp::validate(torn));
  auto const along = scarp::boundary_nodes(box<Element>(2, 0.0), "right").size();
  CHECK_THROWS_WITH_AS(scarp::require_no_duplicate_nodes(torn),
                       doctest::Contains(fmt::format("{} nodes in all are at the place of another", along).c_str()),
                       scarp::InputError);
  CHECK_THROWS_WITH_AS(scarp::require_no_duplicate_nodes(torn),
                       doctest::Contains(Element::dim == 2 ? "both at (1, 0) " : "both at (1, 0, 0) "),
                       scarp::InputError);
}

TEST_CASE("duplicates that differ by the seventh digit are found, near ones are none") {
  auto mesh = box<scarp::Quad4>(1, 0.0);
  auto const part = box<scarp::Quad4>(1, 1.0 + 2e-7);
  CHECK_REFUSED(scarp::require_no_duplicate_nodes(beside(mesh, part)), "are both at");
  CHECK_NOTHROW(scarp::require_no_duplicate_nodes(beside(mesh, box<scarp::Quad4>(1, 1.0 + 1e-5))));
}

TEST_CASE_TEMPLATE("a corner inside another element's side is named with the element", Element, SAMPLE_ELEMENTS) {
  for (int const fine : {2, 3}) {
    auto mesh = box<Element>(1, 0.0);
    scarp::join(mesh, box<Element>(fine, 1.0));
    CHECK_NOTHROW(scarp::validate(mesh));
    CHECK_NOTHROW(scarp::require_no_duplicate_nodes(mesh));
    for (double const scale : {1.0, 1e-4, 1e4}) {
      auto scaled = mesh;
      for (auto& node : scaled.nodes) node *= scale;
      CHECK_THROWS_WITH_AS(scarp::require_no_hanging_nodes(scaled),
                           doctest::Contains("hangs: it is a corner inside a side of element"), scarp::InputError);
    }
  }
}

TEST_CASE("the hanging node and the element are the right ones") {
  auto mesh = box<scarp::Quad4>(1, 0.0);
  scarp::join(mesh, box<scarp::Quad4>(2, 1.0));
  CHECK_THROWS_WITH_AS(
      scarp::require_no_hanging_nodes(mesh),
      doctest::Contains("at (1, 0.5) hangs: it is a corner inside a side of element 0 (nodes 0, 1, 3, 2)"),
      scarp::InputError);
}

TEST_CASE("a corner that hangs in a side up to round-off is found at any place") {
  auto mesh = box<scarp::Quad4>(1, 0.0);
  scarp::join(mesh, box<scarp::Quad4>(2, 1.0));
  scarp::Vector<2> const middle(1.0, 0.5);
  for (auto& node : mesh.nodes)
    node = (node == middle ? scarp::Vector<2>(-5.5e-17, 0.0) : scarp::Vector<2>(node - middle));
  CHECK_THROWS_WITH_AS(scarp::require_no_hanging_nodes(mesh), doctest::Contains("hangs"), scarp::InputError);
}

TEST_CASE("a corner in the middle of a face or of an edge in space hangs") {
  // Two tetrahedra on the ring of a square below, and one element whose face or edge holds their common corner.
  using Place = scarp::Vector<3>;
  scarp::Mesh<scarp::Tet4> mesh;
  mesh.regions = {"soil"};
  mesh.nodes = {Place(0, 0, 0), Place(4, 0, 0), Place(0, 4, 0), Place(0, 0, 4)};
  mesh.elements = {{0, 1, 2, 3}};
  mesh.element_region = {0};
  auto const with_corner = [&](Place const& corner) {
    auto both = mesh;
    both.nodes.insert(both.nodes.end(),
                      {corner, corner - Place(1, 0, 1), corner - Place(0, 1, 1), corner - Place(0, 0, 1)});
    both.elements.push_back({4, 5, 6, 7});
    if (scarp::detail::bad_jacobian(both, 1)) std::swap(both.elements.back()[2], both.elements.back()[3]);
    both.element_region.push_back(0);
    return both;
  };
  CHECK_REFUSED(scarp::require_no_hanging_nodes(with_corner({1.0, 1.5, 0.0})), "(1, 1.5, 0) hangs");  // in a face
  CHECK_REFUSED(scarp::require_no_hanging_nodes(with_corner({2.0, 0.0, 0.0})), "(2, 0, 0) hangs");    // on an edge
  CHECK_NOTHROW(scarp::require_no_hanging_nodes(with_corner({3.0, 3.0, 0.0})));                       // beside the face
  CHECK_NOTHROW(scarp::require_no_hanging_nodes(with_corner({1.0, 1.5, -0.1})));                      // below it
}

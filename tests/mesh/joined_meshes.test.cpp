// SPDX-License-Identifier: BSL-1.0
#include "scarp/mesh/joined_meshes.hpp"

#include <doctest/doctest.h>

#include "scarp/element/hex20.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "support/refusals.hpp"

namespace {

/// A unit box of two cells along each axis, moved along the first.
template <class Element>
scarp::Mesh<Element> box(double shift) {
  using Place = scarp::Vector<Element::dim>;
  return scarp::BoxMesh<Element>{.cells = scarp::BoxMesh<Element>::filled(2),
                                 .map = [shift](Place const& place) -> Place { return place + shift * Place::Unit(0); }}
      .generate();
}

}  // namespace

TEST_CASE_TEMPLATE("boxes side by side share the nodes between them", Element, scarp::Tri6, scarp::Quad8, scarp::Tet10,
                   scarp::Hex20) {
  auto mesh = box<Element>(0.1);
  auto part = box<Element>(1.1 + 1e-13);  // beside it but for round-off
  part.regions = {"rock"};
  auto const shared = scarp::boundary_nodes(mesh, "right").size();
  auto const alone = mesh;
  scarp::join(mesh, part);
  CHECK_NOTHROW(scarp::validate(mesh));
  CHECK(mesh.nodes.size() == alone.nodes.size() + part.nodes.size() - shared);
  CHECK(std::equal(alone.nodes.begin(), alone.nodes.end(), mesh.nodes.begin()));
  CHECK(std::equal(alone.elements.begin(), alone.elements.end(), mesh.elements.begin()));
  CHECK(mesh.regions == std::vector<std::string>{"soil", "rock"});
  CHECK(mesh.element_region.front() == 0);
  CHECK(mesh.element_region.back() == 1);
  CHECK(scarp::boundary(mesh, "bottom").size() == 2 * scarp::boundary(alone, "bottom").size());
}

TEST_CASE("regions of the same name are united, and boxes apart share nothing") {
  auto mesh = box<scarp::Quad4>(0.0);
  scarp::join(mesh, box<scarp::Quad4>(1.0 + 1e-6));  // a gap far above round-off
  CHECK(mesh.nodes.size() == 18);
  CHECK(mesh.elements.size() == 8);
  CHECK(mesh.regions == std::vector<std::string>{"soil"});
}

TEST_CASE("a mesh far from the origin joins as well") {
  auto mesh = box<scarp::Quad4>(5e6);
  scarp::join(mesh, box<scarp::Quad4>(5e6 + 1.0));
  CHECK(mesh.nodes.size() == 15);
}

TEST_CASE("a part before the mesh shares its first node as well") {
  auto mesh = box<scarp::Quad4>(0.0);
  scarp::join(mesh, box<scarp::Quad4>(-1.0));
  CHECK(mesh.nodes.size() == 15);
}

TEST_CASE("an empty mesh becomes the part") {
  scarp::Mesh<scarp::Quad4> mesh;
  auto const part = box<scarp::Quad4>(0.0);
  scarp::join(mesh, part);
  CHECK(mesh.nodes == part.nodes);
  CHECK(mesh.elements == part.elements);
  CHECK(mesh.boundaries == part.boundaries);
}

TEST_CASE("an invalid part is refused and the mesh stays") {
  auto mesh = box<scarp::Quad4>(0.0);
  auto part = box<scarp::Quad4>(1.0);
  std::swap(part.elements[0][0], part.elements[0][1]);
  CHECK_REFUSED(scarp::join(mesh, part), "element 0", "Jacobian -");
  CHECK(mesh.elements.size() == 4);
}

TEST_CASE("a facet between two parts that both have in a boundary is there once") {
  auto mesh = box<scarp::Quad4>(0.0);
  mesh.boundaries["joint"] = mesh.boundaries["right"];
  auto part = box<scarp::Quad4>(1.0);
  part.boundaries["joint"] = part.boundaries["left"];
  scarp::join(mesh, part);
  CHECK_NOTHROW(scarp::validate(mesh));
  CHECK(mesh.boundaries["joint"].size() == 2);
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/mesh/facets.hpp"

#include <doctest/doctest.h>

#include "scarp/element/quad8.hpp"
#include "scarp/mesh/box_mesh.hpp"

TEST_CASE_TEMPLATE("a boundary is made of straight pieces, one behind the other", Element, scarp::Quad4, scarp::Quad8) {
  auto const mesh = scarp::BoxMesh<Element>{.cells = scarp::BoxMesh<Element>::filled(2)}.generate();
  auto const pieces = scarp::straight_facets(mesh, "bottom");
  constexpr int each = Element::facet_nodes - 1;  // pieces of a facet, of equal length
  REQUIRE(pieces.size() == 2 * each);
  double along = 0.0;
  for (auto const& [from, to] : pieces) {
    auto const& start = mesh.nodes[scarp::detail::index(from)];
    auto const& end = mesh.nodes[scarp::detail::index(to)];
    CHECK(start.x() == along);
    along += 0.5 / each;
    CHECK(end.x() == along);  // exact: quarters of the length one
    CHECK(start.y() == 0.0);
    CHECK(end.y() == 0.0);
  }
}

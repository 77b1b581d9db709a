// SPDX-License-Identifier: BSL-1.0
#include "scarp/mesh/mid_side_nodes.hpp"

#include <doctest/doctest.h>

#include "scarp/element/hex20.hpp"
#include "scarp/mesh/box_mesh.hpp"

namespace {

/// An element of the library that says where its nodes are and no longer which corners they lie between.
template <class Element>
struct Placed : Element {
  static constexpr int mid_sides = 0;

  static std::array<scarp::Vector<Element::dim>, Element::nodes> node_places() {
    using Linear = typename Element::Linear;
    std::array<scarp::Vector<Element::dim>, Element::nodes> places;
    for (int vertex = 0; vertex < Linear::nodes; ++vertex) {
      scarp::Vector<Element::dim> xi;
      for (int axis = 0; axis < Element::dim; ++axis) xi(axis) = (vertex >> axis & 1) != 0 ? 1.0 : -1.0;
      int corner = 0;
      Linear::shape(xi).maxCoeff(&corner);
      places[static_cast<std::size_t>(corner)] = xi;
    }
    std::size_t next = Linear::nodes;
    for (auto const& [a, b] : Element::mid_sides()) {
      places[next++] = (places[static_cast<std::size_t>(a)] + places[static_cast<std::size_t>(b)]) / 2.0;
    }
    return places;
  }
};

/// Its nodes do not begin with the corners.
struct Turned : Placed<scarp::Quad8> {
  static std::array<scarp::Vector<2>, 8> node_places() {
    auto places = Placed<scarp::Quad8>::node_places();
    std::swap(places[0], places[4]);
    return places;
  }
};

}  // namespace

TEST_CASE_TEMPLATE("nodes by their places make the same mesh as nodes in the middle of edges", Element, scarp::Quad8,
                   scarp::Hex20) {
  static_assert(scarp::PlacesNodes<Placed<Element>> && !scarp::HasMidSides<Placed<Element>>);
  auto cells = scarp::BoxMesh<Element>::filled(2);
  cells[0] = 3;
  auto const wanted = scarp::BoxMesh<Element>{.cells = cells, .distortion = 0.2}.generate();
  auto const found = scarp::BoxMesh<Placed<Element>>{.cells = cells, .distortion = 0.2}.generate();
  CHECK(found.elements == wanted.elements);
  CHECK(found.boundaries == wanted.boundaries);
  REQUIRE(found.nodes.size() == wanted.nodes.size());
  double worst = 0.0;
  for (std::size_t n = 0; n < found.nodes.size(); ++n)
    worst = std::max(worst, (found.nodes[n] - wanted.nodes[n]).norm());
  CHECK(worst < 1e-15);  // round-off of a mean of two places below 1
}

TEST_CASE("an element whose first nodes are not its corners is refused") {
  CHECK_THROWS_WITH_AS(scarp::BoxMesh<Turned>{}.generate(), doctest::Contains("node_places()"), scarp::InputError);
}

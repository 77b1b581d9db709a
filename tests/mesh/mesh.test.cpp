// SPDX-License-Identifier: BSL-1.0
#include "scarp/mesh/mesh.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/element/hex8.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Naming;

using Mesh = scarp::Mesh<scarp::Tri3>;

/// Unit square of two triangles.
Mesh square() {
  Mesh mesh;
  mesh.nodes = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  mesh.elements = {{0, 1, 2}, {0, 2, 3}};
  mesh.element_region = {0, 1};
  mesh.regions = {"sand", "clay"};
  mesh.boundaries["bottom"] = {{0, 1}};
  mesh.boundaries["sides"] = {{3, 0}, {1, 2}};
  return mesh;
}

std::string complaint(Mesh const& mesh) {
  return samples::message_of([&] { scarp::validate(mesh); });
}

}  // namespace

TEST_CASE("a sound mesh is accepted") { CHECK(complaint(square()) == ""); }

TEST_CASE("an empty mesh is refused") { CHECK(complaint(Mesh{}) == Naming{"empty"}); }

TEST_CASE("an element that names a node beyond the last is refused with its number") {
  auto mesh = square();
  mesh.elements[1][2] = 4;
  CHECK(complaint(mesh) == Naming{"element 1 names node 4"});
  mesh.elements[1][2] = -1;
  CHECK(complaint(mesh) == Naming{"element 1 names node -1"});
}

TEST_CASE("a node that is not at a finite place is refused with its number") {
  auto mesh = square();
  mesh.nodes[2].x() = std::numeric_limits<double>::infinity();
  CHECK(complaint(mesh) == Naming{"node 2 is at (inf"});
}

TEST_CASE("elements that are turned over, flat or flat up to round-off are refused with their number") {
  auto mesh = square();
  std::swap(mesh.elements[1][0], mesh.elements[1][1]);
  CHECK(complaint(mesh) == Naming{"element 1 (nodes 2, 0, 3) has the Jacobian -1"});
  mesh = square();
  mesh.nodes[3] = {0.5, 0.5};
  CHECK(complaint(mesh) == Naming{"element 1"});
  mesh.nodes[3] = {0.5, 0.5 + 1e-13};
  CHECK(complaint(mesh) == Naming{"element 1"});
}

TEST_CASE("what counts as flat goes with the size of the element") {
  for (double const size : {1e-7, 1e7}) {
    auto mesh = square();
    for (auto& node : mesh.nodes) node *= size;
    CHECK(complaint(mesh) == "");
    mesh.nodes[3] = size * scarp::Vector<2>(0.5, 0.5 + 1e-13);
    CHECK(complaint(mesh) == Naming{"element 1"});
  }
}

TEST_CASE("a node that no element uses is refused") {
  auto mesh = square();
  mesh.nodes.emplace_back(7.0, 7.0);
  CHECK(complaint(mesh) == Naming{"node 4 at (7, 7) belongs to no element"});
}

TEST_CASE("region numbers without a name and missing region numbers are refused") {
  auto mesh = square();
  mesh.element_region[0] = 2;
  CHECK(complaint(mesh) == Naming{"element 0 has the region number 2 (the mesh names 2 regions: sand, clay)"});
  mesh.element_region = {0};
  CHECK(complaint(mesh) == Naming{"2 elements but 1 region numbers"});
}

TEST_CASE("a boundary facet that is no element's side is refused") {
  auto mesh = square();
  mesh.boundaries["bottom"] = {{1, 3}};
  CHECK(complaint(mesh) == Naming{"boundary 'bottom' holds the facet (1, 3)"});
}

TEST_CASE("a boundary facet whose nodes are in another order than its element's is refused") {
  auto quadratic = scarp::BoxMesh<scarp::Quad8>{}.generate();
  auto& [first, second, middle] = quadratic.boundaries.begin()->second[0];
  std::swap(first, second);
  CHECK(samples::message_of([&] { scarp::validate(quadratic); }) == "");  // the other way round
  std::swap(second, middle);
  CHECK(samples::message_of([&] { scarp::validate(quadratic); }) == Naming{"in the order"});
  auto solid = scarp::BoxMesh<scarp::Hex8>{}.generate();
  auto& side = solid.boundaries.begin()->second[0];
  std::rotate(side.begin(), side.begin() + 1, side.end());
  CHECK(samples::message_of([&] { scarp::validate(solid); }) == "");  // from another corner
  std::swap(side[0], side[1]);
  CHECK(samples::message_of([&] { scarp::validate(solid); }) == Naming{"in the order"});
}

TEST_CASE("boundary nodes come sorted and once each") {
  auto mesh = square();
  mesh.boundaries["ring"] = {{3, 0}, {1, 2}, {0, 1}, {2, 3}};
  CHECK(scarp::boundary_nodes(mesh, "ring") == std::vector<int>{0, 1, 2, 3});
}

TEST_CASE("unknown names are refused with the known ones") {
  CHECK_REFUSED(scarp::boundary_nodes(square(), "top"), "boundary 'top'", "bottom, sides");
  CHECK_REFUSED(scarp::region_number(square(), "rock"), "region 'rock'", "sand, clay");
  CHECK(scarp::region_number(square(), "clay") == 1);
}

TEST_CASE("a facet that is in a boundary twice is refused, in whatever order of its nodes") {
  auto mesh = square();
  mesh.boundaries["bottom"] = {{0, 1}, {1, 0}};
  CHECK(complaint(mesh) == Naming{"boundary 'bottom' holds the facet (1, 0) twice"});
  mesh.boundaries["bottom"] = {{0, 1}};
  mesh.boundaries["all"] = {{0, 1}, {1, 2}};  // in another boundary it may be
  CHECK(complaint(mesh) == "");
}

TEST_CASE("a boundary without facets is refused to whoever asks for it") {
  auto mesh = square();
  mesh.boundaries["drain"];
  CHECK(complaint(mesh) == "");
  CHECK_REFUSED(scarp::boundary(mesh, "drain"), "the boundary 'drain' has no facets");
  CHECK_REFUSED(scarp::boundary_nodes(mesh, "drain"), "the boundary 'drain' has no facets");
}

TEST_CASE("elements that overlap are refused with their numbers") {
  auto twice = square();
  twice.elements.push_back({1, 2, 0});
  twice.element_region.push_back(1);
  CHECK(complaint(twice) == Naming{"elements 0 and 2 lie on the same side of a facet"});
  auto folded = square();  // a third element at one facet
  folded.nodes.push_back({0.9, 0.1});
  folded.elements.push_back({0, 4, 2});
  folded.element_region.push_back(1);
  CHECK(complaint(folded) == Naming{"lie on the same side"});
}

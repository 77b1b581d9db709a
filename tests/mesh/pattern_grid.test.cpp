// SPDX-License-Identifier: BSL-1.0
#include "scarp/mesh/pattern_grid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "scarp/element/hex8.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/element/tet4.hpp"
#include "scarp/element/tri6.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Pattern;

std::vector<double> const xs{0.0, 1.0, 3.0};
std::vector<double> const ys{-1.0, 0.0, 0.5, 2.0};

template <class Element>
scarp::Mesh<Element> grid(Pattern pattern, double jitter = 0.0, std::uint64_t seed = 1) {
  scarp::Mesh<Element> mesh;
  mesh.regions = {"soil"};
  auto const numbers = scarp::add_grid_nodes(mesh.nodes, xs, ys);
  scarp::jitter_grid(mesh.nodes, numbers, jitter, seed);
  scarp::add_grid_cells(mesh, numbers, pattern, 0);
  scarp::GridSides const sides(numbers);
  mesh.boundaries = {{"left", sides.left}, {"right", sides.right}, {"bottom", sides.lower}, {"top", sides.upper}};
  return mesh;
}

/// Sides that run neither along x nor along y: how many rise to the right (first) and to the left.
std::pair<int, int> diagonals(scarp::Mesh<scarp::Tri3> const& mesh) {
  std::pair<int, int> found{0, 0};
  for (auto const& element : mesh.elements) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto const at = [&](std::size_t corner) { return mesh.nodes[static_cast<std::size_t>(element[corner % 3])]; };
      scarp::Vector<2> const side = at(k + 1) - at(k);
      if (side.x() * side.y() > 0.0) ++found.first;
      if (side.x() * side.y() < 0.0) ++found.second;
    }
  }
  return found;
}

}  // namespace

TEST_CASE("a pattern decides which way the diagonals rise") {
  using Pair = std::pair<int, int>;
  CHECK(diagonals(grid<scarp::Tri3>(Pattern::right)) == Pair(12, 0));  // analytic: six cells, two triangles beside each
  CHECK(diagonals(grid<scarp::Tri3>(Pattern::left)) == Pair(0, 12));
  CHECK(diagonals(grid<scarp::Tri3>(Pattern::crossed)) ==
        Pair(24, 24));  // four half diagonals, two triangles beside each
}

TEST_CASE("cells of every pattern are the right way round and keep the outline") {
  for (auto const pattern : {Pattern::crossed, Pattern::left, Pattern::right}) {
    auto const mesh = grid<scarp::Tri3>(pattern);
    CHECK_NOTHROW(scarp::validate(mesh));
    CHECK(static_cast<int>(mesh.elements.size()) == 6 * scarp::elements_per_cell<scarp::Tri3>(pattern));
  }
  for (auto const pattern : {Pattern::crossed, Pattern::quads}) {
    auto const mesh = grid<scarp::Quad4>(pattern);
    CHECK_NOTHROW(scarp::validate(mesh));
    CHECK(mesh.elements.size() == 6);
    CHECK(mesh.nodes.size() == 12);
  }
}

TEST_CASE("the largest jitter turns no element over, whatever the seed") {
  std::vector<double> const even{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0};
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    for (auto const pattern : {Pattern::left, Pattern::right}) {
      scarp::Mesh<scarp::Tri3> mesh;
      mesh.regions = {"soil"};
      auto const numbers = scarp::add_grid_nodes(mesh.nodes, even, even);
      scarp::jitter_grid(mesh.nodes, numbers, 0.3, seed);  // some do at 0.4
      scarp::add_grid_cells(mesh, numbers, pattern, 0);
      REQUIRE_NOTHROW(scarp::validate(mesh));
    }
    for (auto const pattern : {Pattern::crossed, Pattern::left, Pattern::right}) {
      REQUIRE_NOTHROW(scarp::validate(grid<scarp::Tri3>(pattern, 0.3, seed)));
    }
    REQUIRE_NOTHROW(scarp::validate(grid<scarp::Quad4>(Pattern::quads, 0.3, seed)));
  }
}

TEST_CASE("nodes move by up to the share of the distance of their nearest neighbour, on whichever side it is") {
  std::vector<double> const even{0.0, 8.0, 16.0}, near_first{0.0, 1.0, 9.0}, near_last{0.0, 8.0, 9.0};
  using Lines = std::pair<std::vector<double>, std::vector<double>>;
  for (auto const& [columns, rows] :
       {Lines{near_first, even}, Lines{near_last, even}, Lines{even, near_first}, Lines{even, near_last}}) {
    double farthest = 0.0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      std::vector<scarp::Vector<2>> nodes;
      auto const numbers = scarp::add_grid_nodes(nodes, columns, rows);
      scarp::jitter_grid(nodes, numbers, 0.3, seed);
      scarp::Vector<2> const middle(columns[1], rows[1]);
      farthest = std::max(farthest, (nodes[static_cast<std::size_t>(numbers(1, 1))] - middle).norm());
    }
    CHECK(farthest <= 0.3);
    CHECK(farthest > 0.27);
  }
}

TEST_CASE("the centre of a crossed cell is the mean of its corners, moved or not") {
  auto const mesh = grid<scarp::Tri3>(Pattern::crossed, 0.3, 4);
  for (std::size_t cell = 0; cell < 6; ++cell) {
    scarp::Vector<2> mean = scarp::Vector<2>::Zero();
    for (std::size_t part = 0; part < 4; ++part) {
      mean += mesh.nodes[static_cast<std::size_t>(mesh.elements[4 * cell + part][0])] / 4.0;
    }
    CHECK((mesh.nodes[static_cast<std::size_t>(mesh.elements[4 * cell][2])] - mean).norm() < 1e-15);
  }
}

TEST_CASE("how many elements a cell becomes") {
  CHECK(scarp::elements_per_cell<scarp::Tri6>(Pattern::crossed) == 4);
  CHECK(scarp::elements_per_cell<scarp::Tri6>(Pattern::left) == 2);
  CHECK(scarp::elements_per_cell<scarp::Quad4>(Pattern::crossed) == 1);
  CHECK(scarp::elements_per_cell<scarp::Tet4>(Pattern::crossed) == 6);
  CHECK(scarp::elements_per_cell<scarp::Hex8>(Pattern::quads) == 1);
  CHECK_REFUSED(scarp::elements_per_cell<scarp::Tri6>(Pattern::quads), "'quads'");
  CHECK_REFUSED(scarp::elements_per_cell<scarp::Quad4>(Pattern::right), "4 nodes");
  CHECK_REFUSED(scarp::elements_per_cell<scarp::Tet4>(Pattern::left), "4 nodes in 3 dimensions");
}

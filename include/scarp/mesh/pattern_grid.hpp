// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "scarp/core/random.hpp"
#include "scarp/mesh/mid_side_nodes.hpp"

namespace scarp {

/// How the rectangles of a grid become triangles or quadrilaterals. The directions of the sides matter: strain
/// localises along them.
enum class Pattern {
  crossed,  ///< four triangles around the centre; the default of grids; for quadrilaterals the same as `quads`
  left,     ///< two triangles, the diagonal rises to the left
  right,    ///< two triangles, the diagonal rises to the right
  quads,    ///< the rectangle itself
};

/// Word of a pattern in options and messages.
constexpr std::string_view name(Pattern pattern) {
  switch (pattern) {
    case Pattern::left: return "left";
    case Pattern::right: return "right";
    case Pattern::quads: return "quads";
    default: return "crossed";
  }
}

/// Elements that one cell of a grid becomes: a rectangle of the plane, or the box that it is the side of in space,
/// where tetrahedra divide it into six whatever the pattern.
/// \throws InputError for triangles of undivided rectangles, and for diagonals in anything but triangles
template <ReferenceElement Element>
int elements_per_cell(Pattern pattern) {
  constexpr int dim = Element::dim;
  constexpr bool simplex = LinearOf<Element>::nodes == dim + 1;
  if (dim == 2 && simplex && pattern == Pattern::quads) {
    reject(
        "triangles are requested in the pattern 'quads' (it does not divide the rectangles): use 'crossed', 'left' "
        "or 'right', or quadrilaterals");
  }
  if (!(dim == 2 && simplex) && (pattern == Pattern::left || pattern == Pattern::right)) {
    reject(
        "the pattern '{}' is requested with elements of {} nodes in {} dimensions (only triangles follow its "
        "diagonals): use 'quads', or triangles",
        name(pattern), Element::nodes, dim);
  }
  if constexpr (!simplex) return 1;
  if constexpr (dim == 3) return 6;
  return pattern == Pattern::crossed ? 4 : 2;
}

/// Numbers of the nodes at the crossings of grid lines: (column line, row line), both from 0.
class GridNumbers {
 public:
  /// Numbers of nodes that are not yet set are -1.
  GridNumbers(int column_lines, int row_lines)
      : row_lines_(row_lines), numbers_(detail::index(column_lines * row_lines), -1) {}

  int columns() const { return detail::count(numbers_) / row_lines_ - 1; }  ///< of cells
  int rows() const { return row_lines_ - 1; }                               ///< of cells

  /// Node at the crossing of a column line and a row line.
  int& operator()(int column, int row) { return numbers_[detail::index(column * row_lines_ + row)]; }
  /// Node at the crossing of a column line and a row line.
  int operator()(int column, int row) const { return numbers_[detail::index(column * row_lines_ + row)]; }

 private:
  int row_lines_;
  std::vector<int> numbers_;
};

/// Adds nodes at the crossings of grid lines.
/// xs, ys: increasing line positions [m]
/// \return the new nodes' numbers
inline GridNumbers add_grid_nodes(std::vector<Vector<2>>& nodes, std::vector<double> const& xs,
                                  std::vector<double> const& ys) {
  GridNumbers numbers(detail::count(xs), detail::count(ys));
  for (int i = 0; i < detail::count(xs); ++i) {
    for (int j = 0; j < detail::count(ys); ++j) {
      numbers(i, j) = detail::count(nodes);
      nodes.emplace_back(xs[detail::index(i)], ys[detail::index(j)]);
    }
  }
  return numbers;
}

/// Moves the nodes inside a grid at random within a disc; the outline stays. Up to a share of 0.3 no half of a cell can
/// turn over: three corners that move by r keep their sense while the least height of their triangle is above 2 r, and
/// that of half a rectangle is at least 0.707 of its shorter side.
/// share: radius of the disc over the distance of the nearest neighbour along the grid lines; from 0 to 0.3
/// seed: the same one gives the same bits
/// \throws InputError for another share
inline void jitter_grid(std::vector<Vector<2>>& nodes, GridNumbers const& numbers, double share, std::uint64_t seed) {
  if (!(share >= 0.0 && share <= 0.3)) {
    reject("the jitter is {} (elements may turn over beyond 0.3): choose one from 0 to 0.3", share);
  }
  if (share == 0.0) return;
  auto const before = nodes;
  auto const at = [&](int i, int j) { return before[detail::index(numbers(i, j))]; };
  Random random(seed);
  auto const in_unit_disc = [&] {
    for (;;) {
      double const along = random.uniform(-1.0, 1.0);
      double const up = random.uniform(-1.0, 1.0);
      if (along * along + up * up <= 1.0) return Vector<2>(along, up);
    }
  };
  for (int i = 1; i < numbers.columns(); ++i) {
    for (int j = 1; j < numbers.rows(); ++j) {
      Vector<2> const here = at(i, j);
      double const nearest = std::min({(at(i - 1, j) - here).norm(), (at(i + 1, j) - here).norm(),
                                       (at(i, j - 1) - here).norm(), (at(i, j + 1) - here).norm()});
      nodes[detail::index(numbers(i, j))] += share * nearest * in_unit_disc();
    }
  }
}

/// Adds the cells between grid nodes, divided by the pattern; crossed cells get a node at the mean of their
/// corners.
/// region: number of the new elements
/// \throws InputError for a pattern that the elements cannot follow
template <class Element>
void add_grid_cells(Mesh<Element>& mesh, GridNumbers const& numbers, Pattern pattern, int region) {
  static_assert(Element::dim == 2 && (Element::nodes == 3 || Element::nodes == 4),
                "a grid becomes straight elements of the plane");
  elements_per_cell<Element>(pattern);  // checks whether both fit
  auto const add = [&](std::array<int, Element::nodes> const& element) {
    mesh.elements.push_back(element);
    mesh.element_region.push_back(region);
  };
  for (int i = 0; i < numbers.columns(); ++i) {
    for (int j = 0; j < numbers.rows(); ++j) {
      std::array<int, 4> const ring{numbers(i, j), numbers(i + 1, j), numbers(i + 1, j + 1), numbers(i, j + 1)};
      if constexpr (Element::nodes == 4) {
        add(ring);
      } else if (pattern == Pattern::crossed) {
        auto const at = [&](std::size_t corner) { return mesh.nodes[detail::index(ring[corner])]; };
        int const centre = detail::count(mesh.nodes);
        mesh.nodes.push_back(((at(0) + at(2)) / 2.0 + (at(1) + at(3)) / 2.0) / 2.0);
        for (std::size_t side = 0; side < ring.size(); ++side) {
          add({ring[side], ring[(side + 1) % ring.size()], centre});
        }
      } else {
        std::size_t const from = pattern == Pattern::right ? 0 : 1;  // a corner on the diagonal
        add({ring[from], ring[from + 1], ring[from + 2]});
        add({ring[from], ring[from + 2], ring[(from + 3) % 4]});
      }
    }
  }
}

/// Facets of a grid's sides, from left to right and from below; they run counter-clockwise around the grid.
struct GridSides {
  std::vector<std::array<int, 2>> left{};   ///< along the first column line
  std::vector<std::array<int, 2>> right{};  ///< along the last column line
  std::vector<std::array<int, 2>> lower{};  ///< along the first row line
  std::vector<std::array<int, 2>> upper{};  ///< along the last row line

  /// The sides of the whole grid.
  explicit GridSides(GridNumbers const& numbers) {
    int const columns = numbers.columns();
    int const rows = numbers.rows();
    for (int j = 0; j < rows; ++j) {
      left.push_back({numbers(0, j + 1), numbers(0, j)});
      right.push_back({numbers(columns, j), numbers(columns, j + 1)});
    }
    for (int i = 0; i < columns; ++i) {
      lower.push_back({numbers(i, 0), numbers(i + 1, 0)});
      upper.push_back({numbers(i + 1, rows), numbers(i, rows)});
    }
  }
};

}  // namespace scarp

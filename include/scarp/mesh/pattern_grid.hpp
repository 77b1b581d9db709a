// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/pattern.hpp"

namespace scarp {

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

/// The grid's lower side from left to right; facets run counter-clockwise around the block.
inline std::vector<std::array<int, 2>> lower_facets(GridNumbers const& numbers, int first_column, int end_column) {
  std::vector<std::array<int, 2>> facets;
  for (int i = first_column; i < end_column; ++i) {
    facets.push_back({numbers(i, 0), numbers(i + 1, 0)});
  }
  return facets;
}

/// Row line `row` from left to right, each facet directed so that the block is below it.
inline std::vector<std::array<int, 2>> upper_facets(GridNumbers const& numbers, int first_column, int end_column,
                                                    int row) {
  std::vector<std::array<int, 2>> facets;
  for (int i = first_column; i < end_column; ++i) {
    facets.push_back({numbers(i + 1, row), numbers(i, row)});
  }
  return facets;
}

/// The grid's left side over some rows from below; facets run from top to bottom.
inline std::vector<std::array<int, 2>> left_facets(GridNumbers const& numbers, int rows) {
  std::vector<std::array<int, 2>> facets;
  for (int j = 0; j < rows; ++j) {
    facets.push_back({numbers(0, j + 1), numbers(0, j)});
  }
  return facets;
}

/// The grid's right side over some rows from below; facets run from bottom to top.
inline std::vector<std::array<int, 2>> right_facets(GridNumbers const& numbers, int columns, int rows) {
  std::vector<std::array<int, 2>> facets;
  for (int j = 0; j < rows; ++j) {
    facets.push_back({numbers(columns, j), numbers(columns, j + 1)});
  }
  return facets;
}

}  // namespace scarp

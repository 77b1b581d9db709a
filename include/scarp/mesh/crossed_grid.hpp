// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "scarp/element/tri3.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Numbers of the grid nodes of a block of cells: (column line, row line), both from 0.
class GridNumbers {
 public:
  GridNumbers(int column_lines, int row_lines)
      : row_lines_(row_lines), numbers_(detail::index(column_lines * row_lines), -1) {}

  int& operator()(int column, int row) { return numbers_[detail::index(column * row_lines_ + row)]; }
  int operator()(int column, int row) const { return numbers_[detail::index(column * row_lines_ + row)]; }

 private:
  int row_lines_;
  std::vector<int> numbers_;
};

/// Adds a block of rectangles between grid lines, each split into four triangles by its centre ("crossed": no diagonal
/// direction is preferred). Nodes whose number in `numbers` is not negative are shared with what the mesh already has.
/// xs, ys: increasing line positions [m]; numbers: (xs, ys) lines, completed here; region: number of the new elements
inline void add_crossed_grid(Mesh<Tri3>& mesh, std::vector<double> const& xs, std::vector<double> const& ys,
                             GridNumbers& numbers, int region) {
  int const columns = detail::count(xs) - 1;
  int const rows = detail::count(ys) - 1;
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      if (numbers(i, j) < 0) {
        numbers(i, j) = detail::count(mesh.nodes);
        mesh.nodes.emplace_back(xs[detail::index(i)], ys[detail::index(j)]);
      }
    }
  }
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      std::array<int, 4> const ring{numbers(i, j), numbers(i + 1, j), numbers(i + 1, j + 1), numbers(i, j + 1)};
      int const centre = detail::count(mesh.nodes);
      mesh.nodes.emplace_back((xs[detail::index(i)] + xs[detail::index(i + 1)]) / 2.0,
                              (ys[detail::index(j)] + ys[detail::index(j + 1)]) / 2.0);
      for (std::size_t side = 0; side < ring.size(); ++side) {
        mesh.elements.push_back({ring[side], ring[(side + 1) % ring.size()], centre});
        mesh.element_region.push_back(region);
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

inline std::vector<std::array<int, 2>> left_facets(GridNumbers const& numbers, int rows) {
  std::vector<std::array<int, 2>> facets;
  for (int j = 0; j < rows; ++j) {
    facets.push_back({numbers(0, j + 1), numbers(0, j)});
  }
  return facets;
}

inline std::vector<std::array<int, 2>> right_facets(GridNumbers const& numbers, int columns, int rows) {
  std::vector<std::array<int, 2>> facets;
  for (int j = 0; j < rows; ++j) {
    facets.push_back({numbers(columns, j), numbers(columns, j + 1)});
  }
  return facets;
}

}  // namespace scarp

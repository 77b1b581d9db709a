// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/element/reference_element.hpp"

namespace scarp::detail {

template <class Element>
inline constexpr bool is_simplex = Element::nodes == Element::dim + 1;

template <class Element>
inline constexpr bool is_cube = Element::nodes == 1 << Element::dim;

/// Vertices of a cell are numbered by bits: bit i is set on the upper side along axis i. Kuhn's division along the
/// cell's diagonal from vertex 0: two triangles or six tetrahedra, one for each order of the axes; neighbours fit.
template <class Element>
  requires is_simplex<Element> std::vector<std::array<int, Element::nodes>> cell_division() {
    constexpr int dim = Element::dim;
    std::vector<std::array<int, index(dim + 1)>> parts;
    std::array<int, index(dim)> axes;
    std::iota(axes.begin(), axes.end(), 0);
    do {
      std::array<int, index(dim + 1)> part{};
      bool odd = false;
      for (int i = 0; i < dim; ++i) {
        part[index(i + 1)] = part[index(i)] + (1 << axes[index(i)]);
        for (int j = 0; j < i; ++j) {
          odd = odd != (axes[index(j)] > axes[index(i)]);
        }
      }
      if (odd) {  // an odd order of the axes would turn the element inside out
        std::swap(part[dim - 1], part[dim]);
      }
      parts.push_back(part);
    } while (std::next_permutation(axes.begin(), axes.end()));
    return parts;
  }

/// The cell itself. The order of its corners is that of the shape functions on [-1, 1]^dim.
template <class Element>
  requires(is_cube<Element> && !is_simplex<Element>)
std::vector<std::array<int, Element::nodes>> cell_division() {
  std::array<int, Element::nodes> part{};
  for (int vertex = 0; vertex < Element::nodes; ++vertex) {
    Vector<Element::dim> xi;
    for (int axis = 0; axis < Element::dim; ++axis) {
      xi(axis) = (vertex >> axis & 1) != 0 ? 1.0 : -1.0;
    }
    int corner = 0;
    Element::shape(xi).maxCoeff(&corner);
    part[index(corner)] = vertex;
  }
  return {part};
}

}  // namespace scarp::detail

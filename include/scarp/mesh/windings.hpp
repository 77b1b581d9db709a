// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <utility>

#include "scarp/core/index.hpp"

namespace scarp::detail {

/// Corners of a plane cell; its nodes are rings of as many: corners, then, if there are any, mid-side nodes.
template <class Cell>
inline constexpr int plane_corners = detail::count(Cell::facets());

/// Whether two lists name the nodes of a side in the same sense of rotation, begun at any corner.
template <class Cell>
bool same_winding(std::array<int, Cell::nodes> const& a, std::array<int, Cell::nodes> const& b) {
  if constexpr (Cell::dim == 1) {
    return a == b;
  } else {
    constexpr int corners = plane_corners<Cell>;
    for (int shift = 0; shift < corners; ++shift) {
      bool same = true;
      for (int k = 0; k < Cell::nodes && same; ++k) {
        int const ring = k / corners * corners;
        same = a[index(k)] == b[index(ring + (k - ring + shift) % corners)];
      }
      if (same) return true;
    }
    return false;
  }
}

/// The same cell run through the other way, in space with the other handedness: its first two local axes are exchanged.
template <class Cell>
std::array<int, Cell::nodes> turned_round(std::array<int, Cell::nodes> nodes) {
  auto turned = nodes;
  if constexpr (Cell::dim == 1) {
    std::swap(turned[0], turned[1]);
  } else if constexpr (Cell::dim == 3) {
    auto const here = Cell::shape({0.11, 0.23, 0.37});  // where no two shape functions have one value
    auto const there = Cell::shape({0.23, 0.11, 0.37});
    for (int k = 0; k < Cell::nodes; ++k) {
      int image = 0;
      (here.array() - there(k)).abs().minCoeff(&image);
      turned[index(k)] = nodes[index(image)];
    }
  } else {
    constexpr int corners = plane_corners<Cell>;
    for (int k = 0; k < Cell::nodes; ++k) {
      bool const mid_side = k >= corners;
      turned[index(k)] = mid_side ? nodes[index(3 * corners - 1 - k)] : nodes[index((corners - k) % corners)];
    }
  }
  return turned;
}

/// Whether two lists of the nodes of a side name them in one order, begun at any corner and either way round. Sides
/// with nodes that are neither corners nor between two of them are not compared.
template <class Cell>
bool is_same_side(std::array<int, Cell::nodes> const& a, std::array<int, Cell::nodes> const& b) {
  if constexpr (Cell::dim == 2) {
    if constexpr (Cell::nodes != plane_corners<Cell> && Cell::nodes != 2 * plane_corners<Cell>) return true;
  }
  return same_winding<Cell>(a, b) || same_winding<Cell>(a, turned_round<Cell>(b));
}

}  // namespace scarp::detail

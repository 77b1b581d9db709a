// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp::detail {

template <std::size_t Corners>
Vector<2> centre_of(std::vector<Vector<2>> const& nodes, std::array<int, Corners> const& ring) {
  Vector<2> sum = Vector<2>::Zero();
  for (int const node : ring) sum += nodes[index(node)];
  return sum / static_cast<double>(Corners);
}

/// Newest-vertex bisection of triangles in the plane (Mitchell, 30 years of newest vertex bisection, JNAIAM). Every
/// triangle has a base, the side that is bisected next; the halves have the two other sides as theirs. Triangles at a
/// bisected side are bisected until all fit. All descendants of a triangle have one of four shapes.
class Bisection {
 public:
  static constexpr double half_a_bisection = 1.1892;  ///< 2^(1/4), of lengths

  struct Triangle {
    std::array<int, 3> nodes;  ///< counter-clockwise; the base goes from the first to the second
    int origin;                ///< the element that it lies in
  };

  explicit Bisection(std::vector<Vector<2>> places) : nodes(std::move(places)) {}

  std::vector<Vector<2>> nodes;
  std::vector<Triangle> triangles{};

  /// excess(nodes): longest side of a triangle over its size; the triangle is bisected as long as a half of it, the
  /// square root of two smaller, is nearer to the size
  /// \throws InputError for more than ten million triangles
  template <class Excess>
  void refine(Excess const& excess) {
    for (bool found = true; found;) {
      found = false;
      double wanted = 0.0;
      for (auto const& triangle : triangles) {
        double const over = excess(triangle.nodes);
        wanted += std::max(1.0, over * over);
        if (over <= half_a_bisection) continue;
        divide(triangle.nodes[0], triangle.nodes[1]);
        found = true;
      }
      if (constexpr double most = 1e7; wanted > most) {
        reject("the size field requires about {:.3g} elements (up to {:.3g} are supported): choose larger sizes",
               wanted, most);
      }
      make_fit();
      std::vector<Triangle> halves;
      for (auto const& triangle : triangles) bisect(triangle, halves);
      triangles = std::move(halves);
    }
  }

  /// A side of the first mesh as the sides that it has become, in its direction.
  void append(std::array<int, 2> const& side, std::vector<std::array<int, 2>>& parts) const {
    int const middle = middle_of(side[0], side[1]);
    if (middle < 0) {
      parts.push_back(side);
    } else {
      append({side[0], middle}, parts);
      append({middle, side[1]}, parts);
    }
  }

 private:
  int middle_of(int a, int b) const {
    auto const found = middles_.find(std::minmax({a, b}));
    return found == middles_.end() ? -1 : found->second;
  }

  void divide(int a, int b) {
    if (!middles_.try_emplace(std::minmax({a, b}), count(nodes)).second) return;
    nodes.emplace_back((nodes[index(a)] + nodes[index(b)]) / 2.0);
  }

  /// A triangle with a bisected side needs a bisected base.
  void make_fit() {
    for (bool changed = true; changed;) {
      changed = false;
      for (auto const& [corners, origin] : triangles) {
        auto const [a, b, c] = corners;
        if (middle_of(a, b) >= 0 || (middle_of(b, c) < 0 && middle_of(c, a) < 0)) continue;
        divide(a, b);
        changed = true;
      }
    }
  }

  void bisect(Triangle const& triangle, std::vector<Triangle>& halves) const {
    auto const [a, b, c] = triangle.nodes;
    int const middle = middle_of(a, b);
    if (middle < 0) {
      halves.push_back(triangle);
    } else {
      bisect({{c, a, middle}, triangle.origin}, halves);
      bisect({{b, c, middle}, triangle.origin}, halves);
    }
  }

  std::map<std::pair<int, int>, int> middles_;  ///< of all sides that are bisected
};

}  // namespace scarp::detail

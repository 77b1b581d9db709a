// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <set>

#include "scarp/mesh/detail/bisection.hpp"

namespace scarp::detail {

/// Quadrilaterals from bisected ones. Two triangles of one region with a common base become one where its angles lie
/// between 20 and 160 degrees; then each of these and of the triangles left is divided from its centre to the middles
/// of its sides. All sides are halved, so that no node hangs.
class Quadrilaterals {
 public:
  using Side = std::array<int, 2>;

  /// region_of(origin); kept: sides of boundaries, which no quadrilateral may cover
  template <class RegionOf>
  Quadrilaterals(Bisection const& bisection, RegionOf const& region_of, std::vector<Side> const& kept)
      : nodes(bisection.nodes) {
    auto const& triangles = bisection.triangles;
    std::set<Side> closed;
    for (auto const& side : kept) closed.insert(sorted(side[0], side[1]));
    std::map<Side, std::size_t> open;  // triangles by their bases
    std::vector<bool> paired(triangles.size(), false);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      auto const& [corners, origin] = triangles[t];
      auto const base = sorted(corners[0], corners[1]);
      auto const [found, is_first] = open.try_emplace(base, t);
      if (is_first || closed.count(base) != 0) continue;
      auto const& other = triangles[found->second];
      std::array<int, 4> const ring{corners[0], other.nodes[2], corners[1], corners[2]};
      if (region_of(origin) != region_of(other.origin) || !is_convex(ring)) continue;
      paired[t] = paired[found->second] = true;
      divide(ring, origin);
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (!paired[t]) divide(triangles[t].nodes, triangles[t].origin);
    }
  }

  std::vector<Vector<2>> nodes;
  std::vector<std::array<int, 4>> elements{};
  std::vector<int> origins{};

  int middle(int a, int b) {
    auto const [found, is_new] = middles_.try_emplace(sorted(a, b), count(nodes));
    if (is_new) nodes.emplace_back((nodes[index(a)] + nodes[index(b)]) / 2.0);
    return found->second;
  }

 private:
  static Side sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

  bool is_convex(std::array<int, 4> const& ring) const {
    for (std::size_t k = 0; k < 4; ++k) {
      Vector<2> const next = nodes[index(ring[(k + 1) % 4])] - nodes[index(ring[k])];
      Vector<2> const last = nodes[index(ring[(k + 3) % 4])] - nodes[index(ring[k])];
      constexpr double sine = 0.342;  // of 20 and 160 degrees
      if (next.x() * last.y() - next.y() * last.x() < sine * next.norm() * last.norm()) return false;
    }
    return true;
  }

  template <std::size_t Corners>
  void divide(std::array<int, Corners> const& ring, int origin) {
    int const centre = count(nodes);
    nodes.push_back(centre_of(nodes, ring));
    for (std::size_t k = 0; k < Corners; ++k) {
      int const last = ring[(k + Corners - 1) % Corners];
      elements.push_back({ring[k], middle(ring[k], ring[(k + 1) % Corners]), centre, middle(last, ring[k])});
      origins.push_back(origin);
    }
  }

  std::map<Side, int> middles_{};
};

}  // namespace scarp::detail

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/element/line.hpp"
#include "scarp/element/map.hpp"

namespace scarp {

namespace detail {
/// \throws InputError for facets that are none, negative nodes, or one that is there twice, whatever the order of its
/// nodes
template <class Facet>
void require_facets(std::string_view what, std::vector<Facet> facets) {
  if (facets.empty()) reject("{} has no facets (nothing can touch or load it): name a boundary with facets", what);
  for (auto& facet : facets) std::sort(facet.begin(), facet.end());
  std::sort(facets.begin(), facets.end());
  auto const twice = std::adjacent_find(facets.begin(), facets.end());
  if (twice != facets.end()) {
    reject("{} has the facet of the nodes ({}) twice (it would count twice): name each facet once", what,
           listed(*twice));
  }
  if (facets.front().front() < 0)
    reject("{} has a facet of node {} (nodes count from 0): give the numbers of the mesh", what,
           facets.front().front());
}
/// \throws InputError for facets of nodes that a mesh of so many has not
template <class Facet>
void require_nodes(std::string_view what, std::vector<Facet> const& facets, std::size_t nodes) {
  for (auto const& facet : facets) {
    int const last = *std::max_element(facet.begin(), facet.end());
    if (detail::index(last) >= nodes)
      reject("{} has a facet of node {} (the mesh has {}): give the numbers of this mesh", what, last, nodes);
  }
}
}  // namespace detail

/// Part of a mesh's outline in the plane, straight facets with the body on their left.
class FacetChain {
 public:
  using Facet = std::array<int, Line2::nodes>;  ///< nodes of a facet, body on the left

  /// A place on the chain: facet, local coordinate in [0, 1], and whether the chain ends there.
  struct ClosestPoint {
    int facet = 0;        ///< number of the facet in the chain
    double xi = 0.0;      ///< local coordinate, 0 at the facet's first node and 1 at its second
    bool at_end = false;  ///< whether the place is an end of the chain to which no place is opposite

    SCARP_MEMBERS(facet, xi, at_end)
  };

  /// Facets in any order, each with the body on its left.
  /// \throws InputError when there is no facet, or one twice
  explicit FacetChain(std::vector<Facet> facets) : facets_(std::move(facets)) {
    detail::require_facets("a chain of facets", facets_);
  }

  std::vector<Facet> const& facets() const { return facets_; }  ///< node numbers of each facet, in the order given

  /// Position [m] of a place of the chain, given those of the mesh's nodes.
  Vector<2> place(ClosestPoint const& foot, std::vector<Vector<2>> const& nodes) const {
    auto const& [a, b] = ends(foot.facet, nodes);
    return (1.0 - foot.xi) * a + foot.xi * b;
  }

  /// Unit vector along a facet; the outward normal is this turned clockwise by a right angle.
  Vector<2> along(int facet, std::vector<Vector<2>> const& nodes) const {
    auto const& [a, b] = ends(facet, nodes);
    return (b - a).normalized();
  }

  /// The place of the chain that a point is opposite to along a direction, a unit vector out of the body: the nearest
  /// one on that line, on either side of the point; without one the nearest place of the chain, `at_end`.
  ClosestPoint project_along(Vector<2> const& point, Vector<2> const& direction,
                             std::vector<Vector<2>> const& nodes) const {
    constexpr double round_off = 1e-12;
    constexpr double grazing = 0.1;  // cosine: steeper facets are not met by this side
    std::optional<ClosestPoint> best;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < detail::count(facets_); ++f) {
      auto const& [a, b] = ends(f, nodes);
      Vector<2> const side = b - a;
      double const cross = side.y() * direction.x() - side.x() * direction.y();  // length times cosine
      if (!(cross > grazing * side.norm())) continue;
      Vector<2> const from = point - a;
      double const xi = (from.y() * direction.x() - from.x() * direction.y()) / cross;
      if (!(xi >= -round_off && xi <= 1.0 + round_off)) continue;
      double const distance = std::abs((side.y() * from.x() - side.x() * from.y()) / cross);
      if (!(distance < least)) continue;
      least = distance;
      best = ClosestPoint{f, std::clamp(xi, 0.0, 1.0), false};
    }
    if (best) return *best;
    ClosestPoint end = nearest(point, nodes);
    end.at_end = true;
    return end;
  }

  /// The nearest place of the chain to a point.
  ClosestPoint nearest(Vector<2> const& point, std::vector<Vector<2>> const& nodes) const {
    ClosestPoint best;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < detail::count(facets_); ++f) {
      auto const& [a, b] = ends(f, nodes);
      ClosestPoint const foot{f, std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0), false};
      double const distance = (point - place(foot, nodes)).squaredNorm();
      if (!(distance < least)) continue;
      least = distance;
      best = foot;
    }
    return best;
  }

 private:
  std::array<Vector<2>, 2> ends(int facet, std::vector<Vector<2>> const& nodes) const {
    auto const& [a, b] = facets_[detail::index(facet)];
    return {nodes[detail::index(a)], nodes[detail::index(b)]};
  }

  std::vector<Facet> facets_;
};

}  // namespace scarp

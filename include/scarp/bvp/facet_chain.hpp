// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/element/line2.hpp"
#include "scarp/element/map.hpp"

namespace scarp {

/// Part of a mesh's outline in the plane, straight facets with the body on their left.
class FacetChain {
 public:
  using Facet = std::array<int, Line2::nodes>;

  /// A place on the chain: facet, local coordinate in [0, 1], and whether it lies at a free end.
  struct Foot {
    int facet = 0;
    double xi = 0.0;
    bool at_end = false;
  };

  /// \throws InputError when there is no facet
  explicit FacetChain(std::vector<Facet> facets) : facets_(std::move(facets)) {
    if (facets_.empty()) refuse("a chain of facets is empty (nothing can touch it): name a boundary with facets");
  }

  std::vector<Facet> const& facets() const { return facets_; }

  Vector<2> place(Foot const& foot, std::vector<Vector<2>> const& nodes) const {
    auto const& [a, b] = ends(foot.facet, nodes);
    return (1.0 - foot.xi) * a + foot.xi * b;
  }

  /// Unit vector along a facet; the outward normal is this turned clockwise by a right angle.
  Vector<2> along(int facet, std::vector<Vector<2>> const& nodes) const {
    auto const& [a, b] = ends(facet, nodes);
    return (b - a).normalized();
  }

  /// The nearest place of the chain to a point.
  Foot nearest(Vector<2> const& point, std::vector<Vector<2>> const& nodes) const {
    Foot best;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < detail::count(facets_); ++f) {
      auto const& [a, b] = ends(f, nodes);
      double const free = (point - a).dot(b - a) / (b - a).squaredNorm();
      Foot const foot{f, std::clamp(free, 0.0, 1.0), false};
      double const distance = (point - place(foot, nodes)).squaredNorm();
      if (!(distance < least)) continue;
      least = distance;
      best = foot;
      best.at_end = (free < 0.0 && is_end(facets_[detail::index(f)][0], 1)) ||
                    (free > 1.0 && is_end(facets_[detail::index(f)][1], 0));
    }
    return best;
  }

 private:
  std::array<Vector<2>, 2> ends(int facet, std::vector<Vector<2>> const& nodes) const {
    auto const& [a, b] = facets_[detail::index(facet)];
    return {nodes[detail::index(a)], nodes[detail::index(b)]};
  }

  /// Whether no facet has the node at its end number `side`.
  bool is_end(int node, std::size_t side) const {
    return std::none_of(facets_.begin(), facets_.end(), [&](Facet const& facet) { return facet[side] == node; });
  }

  std::vector<Facet> facets_;
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// One packing for all points.
/// \tparam PackingType a `Packing`
template <class PackingType>
struct SamePacking {
  PackingType packing{};  ///< start of every point

  SamePacking() = default;
  SamePacking(PackingType start) : packing(std::move(start)) {}  ///< A packing is one.  // NOLINT

  PackingType const& at(Site<PackingType::dim> const&) const { return packing; }  ///< The packing, whatever the site.
};

/// Packings prepared for a list of depths; a site gets the one whose depth is nearest.
/// \tparam PackingType a `Packing`
template <class PackingType>
struct PackingsByDepth {
  std::vector<double> depths;         ///< [m], increasing
  std::vector<PackingType> packings;  ///< one per depth

  /// \throws InputError unless there is a packing for each depth and depths increase
  void validate() const {
    if (depths.empty() || depths.size() != packings.size()) {
      reject("{} depths with {} packings are given (each depth needs one): prepare the column first", depths.size(),
             packings.size());
    }
    double before = -std::numeric_limits<double>::infinity();
    for (double const depth : depths) {
      if (!(depth > before && std::isfinite(depth)))
        reject("a packing's depth {} m follows {} m (depths must be finite and increase): sort them", depth, before);
      before = depth;
    }
  }

  /// \throws InputError as validate() does, and for a point whose depth is not finite or above the ground surface
  PackingType const& at(Site<PackingType::dim> const& site) const {
    validate();
    if (!std::isfinite(site.depth)) reject("point {} lies {} m deep: give it a depth", site.index, site.depth);
    require_below_surface(site.depth);
    auto const nearest = std::min_element(depths.begin(), depths.end(), [&](double a, double b) {
      return std::abs(a - site.depth) < std::abs(b - site.depth);
    });
    return packings[detail::index(nearest - depths.begin())];
  }
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// The same packing everywhere.
template <class PackingType>
struct SamePacking {
  PackingType packing;

  PackingType const& at(Site<PackingType::dim> const&) const { return packing; }
};

/// Packings prepared for a list of depths; a site gets the one whose depth is nearest.
template <class PackingType>
struct PackingsByDepth {
  std::vector<double> depths;         ///< [m], increasing
  std::vector<PackingType> packings;  ///< one per depth

  /// \throws InputError when there is no packing
  PackingType const& at(Site<PackingType::dim> const& site) const {
    if (depths.empty() || depths.size() != packings.size()) {
      refuse("{} depths with {} packings are given (each depth needs one): prepare the column first", depths.size(),
             packings.size());
    }
    auto const nearest = std::min_element(depths.begin(), depths.end(), [&](double a, double b) {
      return std::abs(a - site.depth) < std::abs(b - site.depth);
    });
    return packings[detail::index(nearest - depths.begin())];
  }
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "biaxial_test.hpp"

namespace rve_biaxial {

/// How far two packings of one recipe are apart in stress on the same path: norm of the difference of axial and lateral
/// stress over that of the first, root mean square over all rows and pairs. The norm of `accumulated_apart` in an error
/// budget. NaN for a single packing.
inline double stress_scatter(std::span<Result const> packings) {
  double squares = 0.0;
  long count = 0;
  for (std::size_t i = 0; i < packings.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      auto const& one = packings[i].rows;
      auto const& other = packings[k].rows;
      for (std::size_t row = 0; row < std::min(one.size(), other.size()); ++row) {
        double const apart = std::hypot(one[row].axial_stress - other[row].axial_stress,
                                        one[row].lateral_stress - other[row].lateral_stress) /
                             std::hypot(one[row].axial_stress, one[row].lateral_stress);
        squares += apart * apart;
        ++count;
      }
    }
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace rve_biaxial

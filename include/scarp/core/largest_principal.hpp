// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scarp/core/tensor.hpp"

namespace scarp {

/// Largest magnitude of a symmetric tensor's principal values: the same in whatever axes it is given. NaN in gives NaN out.
/// In the plane by Mohr's circle, in space by the cosine formula of the characteristic cubic (Smith 1961).
template <int Dim>
double largest_principal(Tensor<Dim> const& symmetric) {
  static_assert(Dim == 2 || Dim == 3);
  double const mean = symmetric.trace() / Dim;
  if constexpr (Dim == 2) {
    return std::abs(mean) + std::hypot((symmetric(0, 0) - symmetric(1, 1)) / 2.0, symmetric(0, 1));
  } else {
    Tensor<3> const deviator = symmetric - mean * Tensor<3>::Identity();
    double const radius = deviator.norm() / std::sqrt(6.0);
    if (radius == 0.0) return std::abs(mean);
    double const cosine = (deviator / radius).determinant() / 2.0;
    double const angle = std::acos(std::clamp(cosine, -1.0, 1.0)) / 3.0;
    double const largest = mean + 2.0 * radius * std::cos(angle);
    double const least = mean + 2.0 * radius * std::cos(angle + 2.0 * std::numbers::pi / 3.0);
    return std::max(std::abs(largest), std::abs(least));
  }
}

}  // namespace scarp

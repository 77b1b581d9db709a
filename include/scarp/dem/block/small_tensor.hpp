// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "scarp/core/host_device.hpp"

namespace scarp::detail {

/// A tensor row by row, for code that runs where Eigen does not.
template <int Dim>
using SmallTensor = std::array<double, static_cast<std::size_t>(Dim* Dim)>;
template <int Dim>
using SmallVector = std::array<double, static_cast<std::size_t>(Dim)>;

template <int Dim>
SCARP_HOST_DEVICE constexpr double determinant_of(SmallTensor<Dim> const& m) {
  if constexpr (Dim == 2) {
    return m[0] * m[3] - m[1] * m[2];
  } else {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
  }
}

/// Transposed cofactors: the inverse times the determinant.
template <int Dim>
SCARP_HOST_DEVICE constexpr SmallTensor<Dim> adjugate_of(SmallTensor<Dim> const& m) {
  if constexpr (Dim == 2) {
    return {m[3], -m[1], -m[2], m[0]};
  } else {
    return {m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
            m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
            m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
  }
}

template <int Dim>
SCARP_HOST_DEVICE constexpr SmallTensor<Dim> inverse_of(SmallTensor<Dim> const& m) {
  double const scale = 1.0 / determinant_of<Dim>(m);
  auto inverse = adjugate_of<Dim>(m);
  for (auto& entry : inverse) entry *= scale;
  return inverse;
}

template <int Dim>
SCARP_HOST_DEVICE constexpr SmallTensor<Dim> product_of(SmallTensor<Dim> const& a, SmallTensor<Dim> const& b) {
  constexpr auto n = static_cast<std::size_t>(Dim);
  SmallTensor<Dim> c{};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) c[i * n + j] += a[i * n + k] * b[k * n + j];
    }
  }
  return c;
}

template <int Dim>
SCARP_HOST_DEVICE constexpr SmallTensor<Dim> identity_tensor() {
  SmallTensor<Dim> one{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(Dim); ++i) one[i * static_cast<std::size_t>(Dim) + i] = 1.0;
  return one;
}

/// See `exponential_of_small`.
template <int Dim>
SCARP_HOST_DEVICE constexpr SmallTensor<Dim> small_exponential(SmallTensor<Dim> const& small) {
  auto const one = identity_tensor<Dim>();
  SmallTensor<Dim> sum = one;
  for (double const divisor : {4.0, 3.0, 2.0, 1.0}) {
    auto const next = product_of<Dim>(small, sum);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = one[k] + next[k] / divisor;
  }
  return sum;
}

template <int Dim>
SCARP_HOST_DEVICE constexpr double size_of_tensor(SmallTensor<Dim> const& m) {
  double squared = 0.0;
  for (double const entry : m) squared += entry * entry;
  return std::sqrt(squared);
}

/// See `lattice_reduction`: integers as doubles.
template <int Dim>
SCARP_HOST_DEVICE constexpr SmallTensor<Dim> reduction_of(SmallTensor<Dim> cell) {
  constexpr auto n = static_cast<std::size_t>(Dim);
  auto change = identity_tensor<Dim>();
  constexpr double half = 0.5 + 1e-9;
  for (bool reduced = false; !reduced;) {
    reduced = true;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (i == j) continue;
        double along = 0.0;
        double squared = 0.0;
        for (std::size_t a = 0; a < n; ++a) {
          along += cell[a * n + i] * cell[a * n + j];
          squared += cell[a * n + j] * cell[a * n + j];
        }
        double const ratio = along / squared;
        double const size = ratio < 0.0 ? -ratio : ratio;
        if (!(size > half) || size > 1e6) continue;
        double const multiple = std::round(ratio);
        for (std::size_t a = 0; a < n; ++a) {
          cell[a * n + i] -= multiple * cell[a * n + j];
          change[a * n + i] -= multiple * change[a * n + j];
        }
        reduced = false;
      }
    }
  }
  return change;
}

/// Largest principal value of a symmetric tensor that has no negative one, as `largest_principal`.
template <int Dim>
SCARP_HOST_DEVICE constexpr double largest_principal_of(SmallTensor<Dim> const& m) {
  if constexpr (Dim == 2) {
    double const half = (m[0] - m[3]) / 2.0;
    return (m[0] + m[3]) / 2.0 + std::sqrt(half * half + m[1] * m[1]);  // the same bits on every device, unlike hypot
  } else {
    double const mean = (m[0] + m[4] + m[8]) / 3.0;
    auto deviator = m;
    for (std::size_t k = 0; k < 9; k += 4) deviator[k] -= mean;
    double const radius = size_of_tensor<3>(deviator) / std::sqrt(6.0);
    if (radius == 0.0) return mean;
    for (double& entry : deviator) entry /= radius;
    double cosine = determinant_of<3>(deviator) / 2.0;
    cosine = cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine;
    return mean + 2.0 * radius * std::cos(std::acos(cosine) / 3.0);
  }
}

}  // namespace scarp::detail

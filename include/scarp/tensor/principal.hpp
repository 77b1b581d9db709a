// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scarp/core/precompiled.hpp"
#include "scarp/tensor/tensor.hpp"
#include "scarp/tensor/voigt.hpp"
#ifdef SCARP_DEFINITIONS
#include <Eigen/Eigenvalues>
#endif

namespace scarp {

/// Principal values, largest first, and their directions as columns.
struct Principal {
  Vector<3> values;      ///< descending
  Tensor<3> directions;  ///< unit vectors, one in each column
};

/// Principal values and directions of a symmetric tensor, of which only the lower triangle is read.
SCARP_EXPORT Principal principal(Tensor<3> const& symmetric);

/// Principal values of a symmetric tensor, largest first. In the plane by Mohr's circle, to round-off of the largest.
template <int Dim>
Vector<Dim> principal_values(Tensor<Dim> const& symmetric) {
  static_assert(Dim == 2 || Dim == 3);
  if constexpr (Dim == 2) {
    double const mean = symmetric.trace() / 2.0;
    double const radius = std::hypot((symmetric(0, 0) - symmetric(1, 1)) / 2.0, symmetric(1, 0));
    return {mean + radius, mean - radius};
  } else {
    return principal(symmetric).values;
  }
}

/// Derivative of an isotropic function of a symmetric tensor from the function's principal values.
/// of_values: derivative of the function's principal values with respect to the argument's, shape (3, 3)
/// argument, value: principal values of both, in the same order; directions: common, as columns
/// \f$ D = \sum_{ab} D_{ab}\, M_a \otimes M_b + \sum_{a<b} 4 g_{ab}\, S_{ab} \otimes S_{ab},
///     \; 2 g_{ab} = (s_a - s_b)/(e_a - e_b) \f$
/// with M_a = n_a n_a, S_ab the symmetric part of n_a n_b (Ogden 1984; de Souza Neto et al., app. A). Equal arguments
/// give the limit.
/// \return with respect to engineering strain, shape (6, 6)
SCARP_EXPORT VoigtTangent<3> isotropic_derivative(Tensor<3> const& of_values, Vector<3> const& argument,
                                                  Vector<3> const& value, Tensor<3> const& directions);

/// Largest magnitude of a symmetric tensor's principal values: the same in whatever axes it is given. NaN in gives NaN
/// out, beside an infinity that. In the plane by Mohr's circle, in space by the cosine formula of the characteristic
/// cubic (Smith 1961).
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

#ifdef SCARP_DEFINITIONS
SCARP_DEFINITIONS Principal principal(Tensor<3> const& symmetric) {
  Eigen::SelfAdjointEigenSolver<Tensor<3>> const solver(symmetric);
  return {solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse()};
}

SCARP_DEFINITIONS VoigtTangent<3> isotropic_derivative(Tensor<3> const& of_values, Vector<3> const& argument,
                                                       Vector<3> const& value, Tensor<3> const& directions) {
  Eigen::Matrix<double, 6, 3> along;
  for (int a = 0; a < 3; ++a) {
    Tensor<3> const dyad = directions.col(a) * directions.col(a).transpose();
    along.col(a) = to_voigt_stress<3, double>(dyad);
  }
  VoigtTangent<3> derivative = along * of_values * along.transpose();
  double const size = argument.cwiseAbs().maxCoeff();
  for (int a = 0; a < 3; ++a) {
    for (int b = a + 1; b < 3; ++b) {
      double const apart = argument(a) - argument(b);
      double const slope = std::abs(apart) > 1e-8 * size
                               ? (value(a) - value(b)) / apart
                               : (of_values(a, a) - of_values(a, b) + of_values(b, b) - of_values(b, a)) / 2.0;
      Tensor<3> const across = directions.col(a) * directions.col(b).transpose();
      VoigtStress<3> const shear = to_voigt_stress<3, double>(across);
      derivative += 2.0 * slope * shear * shear.transpose();
    }
  }
  return derivative;
}
#endif

}  // namespace scarp

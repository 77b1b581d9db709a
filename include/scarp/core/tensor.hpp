// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include "scarp/core/one_version.hpp"

namespace scarp {

template <int Dim, class Scalar = double>
using Vector = Eigen::Matrix<Scalar, Dim, 1>;

template <int Dim, class Scalar = double>
using Tensor = Eigen::Matrix<Scalar, Dim, Dim>;

/// Displacement gradient of a load increment, \f$ G_{ij} = \partial \Delta u_i / \partial X_j \f$ with X the
/// configuration at the start of the increment; rotation included. Dimensionless.
template <int Dim, class Scalar = double>
using Gradient = Tensor<Dim, Scalar>;

/// Rotation that turns the xx-axis part of a tensor by `angle` [rad], counter-clockwise.
template <class Scalar>
Tensor<2, Scalar> rotation(Scalar angle) {
  using std::cos;
  using std::sin;
  Tensor<2, Scalar> turn;
  turn << cos(angle), -sin(angle), sin(angle), cos(angle);
  return turn;
}

}  // namespace scarp

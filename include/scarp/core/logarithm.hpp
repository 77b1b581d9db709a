// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <limits>

#include "scarp/core/tensor.hpp"

namespace scarp {

/// Logarithm of I + gradient: the velocity gradient that, held constant for unit time, moves the identity to I + gradient.
/// \f$ \ln(I + G) = 2\,artanh(G (2I + G)^{-1}) \f$ summed to round-off; meant for increments well below 1.
/// An increment too large for the series gives NaN, which the caller's status check finds.
template <int Dim>
Tensor<Dim> logarithm_of_increment(Gradient<Dim> const& gradient) {
  Tensor<Dim> const identity = Tensor<Dim>::Identity();
  Tensor<Dim> const ratio = gradient * (2.0 * identity + gradient).inverse();
  Tensor<Dim> const squared = ratio * ratio;
  Tensor<Dim> power = ratio;
  Tensor<Dim> sum = ratio;
  constexpr int most_terms = 60;  // |ratio| up to 0.7 converges to 1e-17 within these
  for (int k = 3; k < 2 * most_terms; k += 2) {
    power = (power * squared).eval();
    sum += power / k;
    if (!(power.cwiseAbs().maxCoeff() > 1e-18)) return 2.0 * sum;
  }
  return Tensor<Dim>::Constant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace scarp

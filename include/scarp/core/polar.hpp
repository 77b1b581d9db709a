// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>

#include <cmath>

#include "scarp/core/tensor.hpp"

namespace scarp {

/// Orthogonal factor R of the polar decomposition F = R U by Newton's iteration
/// \f$ R_{k+1} = (R_k + R_k^{-T})/2,\; R_0 = F \f$   N. J. Higham, "Computing the polar decomposition - with
/// applications", SIAM J. Sci. Stat. Comput. 7 (1986) 1160.
/// The iteration converges quadratically: once an iterate moves by less than the square root of the round-off, the
/// new one is exact to round-off. F near a rotation takes 2 to 5 iterations.
/// deformation: invertible, with positive determinant when a proper rotation is wanted (the caller checks)
/// \return R, shape (Dim, Dim); not finite when F is singular or not finite
template <int Dim, class Scalar>
Tensor<Dim, Scalar> rotation_factor(Tensor<Dim, Scalar> const& deformation) {
  using std::sqrt;
  constexpr int most_iterations = 100;  // halves the largest singular value at worst: enough for any finite double
  Scalar const close = sqrt(Eigen::NumTraits<Scalar>::epsilon());
  Tensor<Dim, Scalar> turn = deformation;
  for (int k = 0; k < most_iterations; ++k) {
    Tensor<Dim, Scalar> const next = (turn + turn.inverse().transpose()) / Scalar(2);
    Scalar const moved = (next - turn).norm();
    turn = next;
    if (!(moved > close)) {
      break;
    }
  }
  return turn;
}

}  // namespace scarp

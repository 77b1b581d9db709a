// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "scarp/core/precompiled.hpp"
#include "scarp/core/status.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp {

/// Orthogonal factor R of the polar decomposition F = R U by Newton's iteration
/// \f$ R_{k+1} = (R_k + R_k^{-T})/2,\; R_0 = F \f$   N. J. Higham, "Computing the polar decomposition - with
/// applications", SIAM J. Sci. Stat. Comput. 7 (1986) 1160.
/// The iteration converges quadratically: once an iterate moves by less than the square root of the round-off, the
/// new one is exact to round-off. F near a rotation requires 2 to 5 iterations.
/// deformation: invertible, with positive determinant when a proper rotation is wanted (the caller checks)
/// \return R, shape (Dim, Dim); not finite when F is singular or not finite
template <int Dim, class Scalar>
Tensor<Dim, Scalar> rotation_factor(Tensor<Dim, Scalar> const& deformation) {
  using std::sqrt;
  constexpr int max_iterations = 1100;  // halves the largest singular value at worst: enough for any finite double
  Scalar const close = sqrt(Eigen::NumTraits<Scalar>::epsilon());
  Tensor<Dim, Scalar> turn = deformation;
  for (int k = 0; k < max_iterations; ++k) {
    Tensor<Dim, Scalar> const next = (turn + turn.inverse().transpose()) / Scalar(2);
    Scalar const moved = (next - turn).norm();
    turn = next;
    if (!(moved > close)) {
      break;
    }
  }
  return turn;
}

/// \f$ R\,T\,R^T \f$: a tensor turned by a rotation or mirrored by a reflection R.
template <int Dim>
SCARP_EXPORT Tensor<Dim> turned(Tensor<Dim> const& turn, Tensor<Dim> const& tensor) {
  return turn * tensor * turn.transpose();
}

/// An increment of displacement as a stretch and a rotation after it, I + gradient = R U.
/// \f$ E = 2 (U - I)(U + I)^{-1} \f$ is the strain of the stretch with respect to its half-way configuration; it
/// differs from ln U by E^3/12, so a large increment and the same one in many parts agree to second order.
template <int Dim>
struct SCARP_EXPORT RotatedIncrement {
  Tensor<Dim> turn = Tensor<Dim>::Identity();  ///< R
  Tensor<Dim> strain = Tensor<Dim>::Zero();    ///< E, before the rotation
  Verdict verdict;  ///< not_finite, or element_inverted where det(I + gradient) is not positive

  /// Splits I + gradient, shape (Dim, Dim); `verdict` reports a gradient that is not finite or turns the element inside
  /// out.
  explicit RotatedIncrement(Gradient<Dim> const& gradient);
};

template <int Dim>
RotatedIncrement<Dim>::RotatedIncrement(Gradient<Dim> const& gradient) {
  Tensor<Dim> const identity = Tensor<Dim>::Identity();
  Tensor<Dim> const deformation = identity + gradient;
  double const growth = deformation.determinant();
  if (!gradient.allFinite() || !std::isfinite(growth)) {
    verdict = {Status::failed, Reason::not_finite};
  } else if (!(growth > 0.0)) {
    verdict = {Status::failed, Reason::element_inverted};
  } else {
    turn = rotation_factor<Dim, double>(deformation);
    Tensor<Dim> const stretch = turn.transpose() * deformation;
    strain = 2.0 * (stretch - identity) * (stretch + identity).inverse();
  }
}

#ifdef SCARP_PRECOMPILED
extern template Tensor<2> turned(Tensor<2> const&, Tensor<2> const&);
extern template Tensor<3> turned(Tensor<3> const&, Tensor<3> const&);
extern template struct RotatedIncrement<2>;
extern template struct RotatedIncrement<3>;
#endif

/// Logarithm of I + gradient: the velocity gradient that, held constant for unit time, moves the identity to I +
/// gradient.
/// \f$ \ln(I + G) = 2\,artanh(G (2I + G)^{-1}) \f$ summed to round-off; meant for increments well below 1.
/// An increment too large for the series gives NaN, which the caller's status check finds.
template <int Dim>
Tensor<Dim> logarithm_of_increment(Gradient<Dim> const& gradient) {
  Tensor<Dim> const identity = Tensor<Dim>::Identity();
  Tensor<Dim> const ratio = gradient * (2.0 * identity + gradient).inverse();
  Tensor<Dim> const squared = ratio * ratio;
  Tensor<Dim> power = ratio;
  Tensor<Dim> sum = ratio;
  constexpr int max_terms = 60;  // |ratio| up to 0.7 converges to 1e-17 within these
  for (int k = 3; k < 2 * max_terms; k += 2) {
    power = (power * squared).eval();
    sum += power / k;
    if (!(power.cwiseAbs().maxCoeff() > 1e-18)) return 2.0 * sum;
  }
  return Tensor<Dim>::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// Exponential by its Taylor series to fourth order: exact to round-off for the displacement gradient of one time step.
template <int Dim>
Tensor<Dim> exponential_of_small(Tensor<Dim> const& small) {
  Tensor<Dim> const identity = Tensor<Dim>::Identity();
  return identity + small * (identity + small * (identity + small * (identity + small / 4.0) / 3.0) / 2.0);
}

}  // namespace scarp

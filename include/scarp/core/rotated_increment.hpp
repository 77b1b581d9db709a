// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/polar.hpp"
#include "scarp/core/status.hpp"

namespace scarp {

/// An increment of displacement as a stretch and a rotation after it, I + gradient = R U.
/// \f$ E = 2 (U - I)(U + I)^{-1} \f$ is the strain of the stretch with respect to its half-way configuration; it differs from
/// ln U by E^3/12, so a large increment and the same one in many parts agree to second order.
template <int Dim>
struct RotatedIncrement {
  Tensor<Dim> turn = Tensor<Dim>::Identity();  ///< R
  Tensor<Dim> strain = Tensor<Dim>::Zero();    ///< E, before the rotation
  Verdict verdict;  ///< not_finite, or element_inverted where det(I + gradient) is not positive

  explicit RotatedIncrement(Gradient<Dim> const& gradient) {
    Tensor<Dim> const identity = Tensor<Dim>::Identity();
    Tensor<Dim> const deformation = identity + gradient;
    if (!gradient.allFinite()) {
      verdict = {Status::failed, Reason::not_finite};
    } else if (!(deformation.determinant() > 0.0)) {
      verdict = {Status::failed, Reason::element_inverted};
    } else {
      turn = rotation_factor<Dim, double>(deformation);
      Tensor<Dim> const stretch = turn.transpose() * deformation;
      strain = 2.0 * (stretch - identity) * (stretch + identity).inverse();
    }
  }
};

}  // namespace scarp

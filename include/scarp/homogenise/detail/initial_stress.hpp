// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/index.hpp"
#include "scarp/core/voigt.hpp"

namespace scarp {

/// What a present stress adds to the change of Cauchy's stress with strain, because branches and volume change while
/// the forces stay: \f$ d\sigma = \sigma\varepsilon - \sigma\,tr\,\varepsilon \f$ (symmetric part). [Pa], not symmetric
template <int Dim>
VoigtTangent<Dim> initial_stress_tangent(Tensor<Dim> const& stress) {
  VoigtTangent<Dim> tangent;
  constexpr auto indices = voigt_indices<Dim>();
  for (int k = 0; k < voigt_size<Dim>; ++k) {
    auto const [i, j] = indices[detail::index(k)];
    Tensor<Dim> strain = Tensor<Dim>::Zero();
    strain(i, j) += 0.5;
    strain(j, i) += 0.5;
    tangent.col(k) = to_voigt_stress<Dim, double>(stress * strain - stress * strain.trace());
  }
  return tangent;
}

}  // namespace scarp

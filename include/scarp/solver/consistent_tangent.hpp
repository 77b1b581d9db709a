// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/solver/tangent_rule.hpp"

namespace scarp {

/// Newton's method: every iteration takes the provider's tangent at its trial state. Residuals fall quadratically where that is
/// the derivative of the answer and the answer is smooth.
struct ConsistentTangent {
  double floor = 0.0;  ///< share of the first tangent that is mixed in, against singular systems at a limit load

  /// What the last accepted iteration ended with: the provider's tangent of the committed state with the floor in it.
  template <int Dim>
  VoigtTangent<Dim> start(VoigtTangent<Dim> const&, VoigtTangent<Dim> const& learned) const {
    return learned;
  }

  template <int Dim>
  VoigtTangent<Dim> at_trial(VoigtTangent<Dim> const& trial, VoigtTangent<Dim> const& first) const {
    return (1.0 - floor) * trial + floor * first;
  }
};

static_assert(TangentRule<ConsistentTangent, 2> && TangentRule<ConsistentTangent, 3>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/solver/tangent_rule.hpp"

namespace scarp {

/// The provider's tangent at the start of the step, unchanged while it iterates (modified Newton).
struct FrozenTangent {
  template <int Dim>
  VoigtTangent<Dim> start(VoigtTangent<Dim> const& provider, VoigtTangent<Dim> const&) const {
    return provider;
  }

  template <int Dim>
  VoigtTangent<Dim> update(VoigtTangent<Dim> const& tangent, VoigtTangent<Dim> const&, EngineeringStrain<Dim> const&,
                           VoigtStress<Dim> const&) const {
    return tangent;
  }
};

static_assert(TangentRule<FrozenTangent, 2> && TangentRule<FrozenTangent, 3>);

}  // namespace scarp

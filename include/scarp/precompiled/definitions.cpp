// SPDX-License-Identifier: BSL-1.0
#define SCARP_DEFINITIONS
#include "scarp/constitutive/detail/mohr_coulomb_return.hpp"
#include "scarp/core/gmres.hpp"
#include "scarp/solver/linear_system.hpp"
#include "scarp/solver/tangent_rules.hpp"

namespace scarp {
template VoigtTangent<2> detail::raised<2>(VoigtTangent<2> const&, double);
template VoigtTangent<3> detail::raised<3>(VoigtTangent<3> const&, double);
}  // namespace scarp

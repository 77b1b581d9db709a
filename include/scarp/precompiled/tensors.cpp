// SPDX-License-Identifier: BSL-1.0
#define SCARP_DEFINITIONS
#include "scarp/tensor/finite_strain.hpp"
#include "scarp/tensor/principal.hpp"

namespace scarp {
template struct RotatedIncrement<2>;
template struct RotatedIncrement<3>;
}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#define SCARP_DEFINITIONS
#include "scarp/tensor/finite_strain.hpp"
#include "scarp/tensor/principal.hpp"

namespace scarp {
template Tensor<2> turned(Tensor<2> const&, Tensor<2> const&);
template Tensor<3> turned(Tensor<3> const&, Tensor<3> const&);
template struct RotatedIncrement<2>;
template struct RotatedIncrement<3>;
}  // namespace scarp

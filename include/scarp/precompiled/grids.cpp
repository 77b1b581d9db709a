// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/usual_integration.hpp"

namespace scarp {
template class Discretisation<Tri3, UpdatedLagrangian, UsualIntegration<Tri3>>;
template class Discretisation<Tri6, UpdatedLagrangian, UsualIntegration<Tri6>>;
template class Discretisation<Quad4, UpdatedLagrangian, UsualIntegration<Quad4>>;
template class Discretisation<Quad8, UpdatedLagrangian, UsualIntegration<Quad8>>;
}  // namespace scarp

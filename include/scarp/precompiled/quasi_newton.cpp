// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/quasi_newton.hpp"

namespace scarp {
template class QuasiNewtonSession<QuasiNewton<>, 2>;
template class QuasiNewtonSession<QuasiNewton<>, 3>;
template class QuasiNewtonSession<QuasiNewton<ConsistentTangent>, 2>;
template class QuasiNewtonSession<QuasiNewton<ConsistentTangent>, 3>;
}  // namespace scarp

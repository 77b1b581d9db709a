// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/quasi_newton.hpp"

namespace scarp {
template class QuasiNewtonSession<QuasiNewton<>, IncrementalProblem<2>>;
template class QuasiNewtonSession<QuasiNewton<>, AttachedProblem<2>>;
template class QuasiNewtonSession<QuasiNewton<>, IncrementalProblem<3>>;
template class QuasiNewtonSession<QuasiNewton<ConsistentTangent>, IncrementalProblem<2>>;
template class QuasiNewtonSession<QuasiNewton<ConsistentTangent>, AttachedProblem<2>>;
template class QuasiNewtonSession<QuasiNewton<ConsistentTangent>, IncrementalProblem<3>>;
}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#include "scarp/points/nonlocal.hpp"
#include "scarp/solver/detail/contact_following.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace scarp {
template class MaterialPoints<3>;
template class NonlocalMeans<3>;
template class Problem<3>;
template class detail::ContactFollowing<3>;
template class QuasiNewtonSession<MaterialTangent, 3>;
}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#include "scarp/points/nonlocal.hpp"
#include "scarp/solver/detail/contact_following.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace scarp {
template class MaterialPoints<2>;
template class NonlocalMeans<2>;
template class Problem<2>;
template class detail::ContactFollowing<2>;
template class QuasiNewtonSession<MaterialTangent, 2>;
}  // namespace scarp

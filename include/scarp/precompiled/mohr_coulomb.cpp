// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/detail/mohr_coulomb_return.hpp"

namespace scarp::detail {
SCARP_MOHR_COULOMB(template, 1)
SCARP_MOHR_COULOMB(template, 2)
SCARP_MOHR_COULOMB(template, 3)
}  // namespace scarp::detail

// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/detail/library_kernel.hpp"
#include "scarp/shape/disc.hpp"

namespace scarp::detail {
SCARP_KERNELS(Disc)
}  // namespace scarp::detail

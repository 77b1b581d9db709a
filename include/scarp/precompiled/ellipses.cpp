// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/detail/library_kernel.hpp"
#include "scarp/shape/ellipse.hpp"

namespace scarp::detail {
SCARP_KERNELS(Ellipse)
}  // namespace scarp::detail

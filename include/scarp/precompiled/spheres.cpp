// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/detail/library_kernel.hpp"
#include "scarp/shape/sphere.hpp"

namespace scarp::detail {
SCARP_KERNELS(Sphere)
}  // namespace scarp::detail

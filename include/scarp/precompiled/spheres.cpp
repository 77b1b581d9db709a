// SPDX-License-Identifier: BSL-1.0
#include "scarp/shape/sphere.hpp"

#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/detail/library_kernel.hpp"

namespace scarp::detail {
SCARP_KERNEL(Sphere, Frictionless)
SCARP_KERNEL(Sphere, LinearFrictional)
SCARP_KERNEL(Sphere, HertzMindlin<>)
}  // namespace scarp::detail

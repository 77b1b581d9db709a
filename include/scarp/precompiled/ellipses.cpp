// SPDX-License-Identifier: BSL-1.0
#include "scarp/shape/ellipse.hpp"

#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/detail/library_kernel.hpp"

namespace scarp::detail {
SCARP_KERNEL(Ellipse, Frictionless)
SCARP_KERNEL(Ellipse, LinearFrictional)
SCARP_KERNEL(Ellipse, HertzMindlin<>)
}  // namespace scarp::detail

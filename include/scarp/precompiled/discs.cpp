// SPDX-License-Identifier: BSL-1.0
#include "scarp/shape/disc.hpp"

#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/detail/library_kernel.hpp"

namespace scarp::detail {
SCARP_KERNEL(Disc, Frictionless)
SCARP_KERNEL(Disc, LinearFrictional)
SCARP_KERNEL(Disc, HertzMindlin<>)
}  // namespace scarp::detail

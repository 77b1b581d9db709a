// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/radius_grading.hpp"
#include "scarp/shape/disc.hpp"

namespace scarp {

using DiscGrading = RadiusGrading<Disc>;

}  // namespace scarp

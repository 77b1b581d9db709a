// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/radius_grading.hpp"
#include "scarp/shape/sphere.hpp"

namespace scarp {

using SphereGrading = RadiusGrading<Sphere>;

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/default_grid.hpp"
#include "scarp/fault/fault_scene.hpp"

namespace scarp {
SCARP_GRID(template, Tri3)
SCARP_GROUND(template, Tri3)
}  // namespace scarp

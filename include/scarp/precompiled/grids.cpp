// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/default_grid.hpp"
#include "scarp/fault/fault_scene.hpp"

namespace scarp {
SCARP_GRID(template, Tri6)
SCARP_GRID(template, Quad4)
SCARP_GRID(template, Quad8)
SCARP_GROUND(template, Tri6)
SCARP_GROUND(template, Quad4)
SCARP_GROUND(template, Quad8)
}  // namespace scarp

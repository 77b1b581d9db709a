// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/fault_scene.hpp"

namespace scarp {
SCARP_GROUND(template, Tri3)
SCARP_GROUND(template, Tri6)
SCARP_GROUND(template, Quad4)
SCARP_GROUND(template, Quad8)
}  // namespace scarp

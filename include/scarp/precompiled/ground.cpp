// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/free_field_fault.hpp"

namespace scarp {
SCARP_GROUND(template, Tri3)
SCARP_GROUND(template, Tri6)
SCARP_GROUND(template, Quad4)
SCARP_GROUND(template, Quad8)
SCARP_ELASTIC_GROUND(template)
SCARP_ELASTIC_FREE_FIELD(template)
}  // namespace scarp

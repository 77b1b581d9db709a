// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/usual_integration.hpp"

namespace scarp {
SCARP_GRIDS(template)
}  // namespace scarp

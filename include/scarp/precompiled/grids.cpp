// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/default_integration.hpp"

namespace scarp {
SCARP_GRIDS(template)
}  // namespace scarp

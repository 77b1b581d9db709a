// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/wide_equations.hpp"

namespace scarp {
SCARP_WIDE_SESSIONS(template)
}  // namespace scarp

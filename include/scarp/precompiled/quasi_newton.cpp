// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/quasi_newton.hpp"

namespace scarp {
SCARP_SESSIONS(template)
}  // namespace scarp

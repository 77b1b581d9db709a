// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/rupture_survey.hpp"

namespace scarp {
SCARP_SURVEYS(template)
}  // namespace scarp

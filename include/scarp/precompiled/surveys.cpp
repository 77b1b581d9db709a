// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/rupture_survey.hpp"

namespace scarp {
SCARP_SURVEYS(template)
}  // namespace scarp

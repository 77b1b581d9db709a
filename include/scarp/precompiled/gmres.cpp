// SPDX-License-Identifier: BSL-1.0
#define SCARP_GMRES_DEFINITIONS
#include "scarp/core/gmres.hpp"

// SPDX-License-Identifier: BSL-1.0
#define SCARP_DEFINITIONS
#include "scarp/solver/sparse_lu.hpp"

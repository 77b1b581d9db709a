// SPDX-License-Identifier: BSL-1.0
#define SCARP_SPARSE_LU_DEFINITIONS
#include "scarp/solver/sparse_lu.hpp"

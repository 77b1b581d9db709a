// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/sparse_lu_definitions.hpp"

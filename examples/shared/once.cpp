// SPDX-License-Identifier: BSL-1.0
// What the examples share: precompiled headers and the one compiled copy of the sparse solver.
#include "scarp/solver/sparse_lu_definitions.hpp"

// SPDX-License-Identifier: BSL-1.0
#define SCARP_DEFINITIONS
#include "scarp/constitutive/detail/mohr_coulomb_return.hpp"
#include "scarp/core/gmres.hpp"
#include "scarp/solver/linear_solver.hpp"

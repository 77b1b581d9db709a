// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/random.hpp"

scarp::Random const* other_random();

/// Engineering shear strain of simple shear, computed in the other translation unit.
double other_shear(double strain);

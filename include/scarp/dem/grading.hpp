// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/disc_grading.hpp"
#include "scarp/dem/ellipse_grading.hpp"

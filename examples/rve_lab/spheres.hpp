// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "choices.hpp"
#include "mean_curve.hpp"

namespace rve_lab {

/// The commands for spheres in space, which are compiled by themselves.
/// \throws InputError, PreparationError, FileError
void prepare_spheres(Test const& choice, scarp::RunFolder& own);
/// \return whether the test came to its end
bool test_spheres(Laboratory const& choice, scarp::RunFolder& own);
/// Drained triaxial compression.
Curve curve_of_spheres(Sand const& sand, CurveTest const& test);

}  // namespace rve_lab

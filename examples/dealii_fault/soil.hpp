// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <vector>

#include "../shared/study/choice.hpp"
#include "scarp/points/material_points.hpp"

namespace dealii_fault {

using Points = scarp::MaterialPoints<2>;
using Sites = std::vector<scarp::Site<2>>;

inline constexpr double ground_depth = 25.0;  ///< [m]

/// Makes points at sites with volumes [m3]; this process evaluates the first `own`, the others are seen by means.
using PointMaker = std::function<Points(Sites const& sites, std::vector<double> const& volumes, int own)>;

/// The reference study's soil of a choice and its intrinsic length. sites: of all processes, so that all prepare the
/// same packings
/// \throws scarp::InputError, scarp::PreparationError
PointMaker soil_of(fault_rupture::Choice const& choice, Sites const& sites);

/// Weightless elastic soil without stress, of the reference study's stiffness.
PointMaker stress_free_soil();

/// Lines of the cells that scarp's own scene has for a size [m], along both axes.
std::array<std::vector<double>, 2> cell_lines(double size);

}  // namespace dealii_fault

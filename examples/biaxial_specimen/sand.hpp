// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "choice.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace biaxial_specimen {

/// Packings at all points of a specimen, discs or ellipses. Their DEM is compiled once (sand.cpp), not again for every
/// element.
/// pressure [Pa]: of packings that are prepared; points: of the specimen, more packings than these are not prepared
/// \throws InputError for files that are wrong, PreparationError
scarp::AnyProvider<2> sand(Grains const& grains, double pressure, int points, scarp::ThreadExecutor& executor);

}  // namespace biaxial_specimen

// SPDX-License-Identifier: BSL-1.0
/// \file
/// What watches a run: series for ParaView, profiles of the surface, probes of points, convergence, progress.
/// Observers are told of every attempt at a load step; `observers.hpp` joins several into one.
/// `rupture_survey.hpp` measures a rupture at the surface and inside the ground, `band_angle.hpp` its inclination by
/// strains; settlement counts from `ground_at_rest.hpp`.
/// Lengths in metres; throws are divided by the unit that an observer is given.
/// An observer that writes costs nothing where no scene names it.
#pragma once

#include "scarp/observe/band_angle.hpp"
#include "scarp/observe/convergence_log.hpp"
#include "scarp/observe/fault_offset.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/observe/floor_share.hpp"
#include "scarp/observe/ground_at_rest.hpp"
#include "scarp/observe/level_profile.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/observe/outcrop.hpp"
#include "scarp/observe/packing_series.hpp"
#include "scarp/observe/probe.hpp"
#include "scarp/observe/progress.hpp"
#include "scarp/observe/rupture_measures.hpp"
#include "scarp/observe/rupture_survey.hpp"
#include "scarp/observe/surface_log.hpp"
#include "scarp/observe/surface_point.hpp"
#include "scarp/observe/surface_profile.hpp"

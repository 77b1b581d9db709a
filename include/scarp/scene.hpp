// SPDX-License-Identifier: BSL-1.0
/// \file
/// Composition: a discretisation, a provider for each region, constraints and loads become a problem for a solver.
/// `make_problem(grid, surface_level, hana::make_tuple(Region{"soil", soil}), constraints, loads, executor)`.
/// Regions may have providers of different types; this is the only room where Hana composes.
/// With `nonlocal_scene.hpp` regions may have an intrinsic length.
/// Ready scenes over a fault: room fault.
#pragma once

#include "scarp/scene/nonlocal_scene.hpp"
#include "scarp/scene/region_materials.hpp"
#include "scarp/scene/scene.hpp"

// SPDX-License-Identifier: BSL-1.0
/// \file
/// Ground over a dip-slip fault in the bedrock, bare or with a footing: the first application, the study's scene.
/// `fault_scene.hpp` joins soil, mesh, motion of the bedrock, structure and solver; `free_field_fault.hpp` is the bare
/// one. Structures: `sticking_footing.hpp`, `frictional_footing.hpp`; a structure is one header.
/// Grounds: `layered_ground.hpp` on a grid made for it, `given_ground.hpp` on a mesh of Gmsh. `strip_on_surface.hpp` is
/// what structures need from a mesh. `level_ground.hpp` makes packings for every depth.
/// The load factor is the throw in metres.
#pragma once

#include "scarp/fault/bedrock_motion.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/fault/fault_scene.hpp"
#include "scarp/fault/footing_log.hpp"
#include "scarp/fault/footing_motion.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/fault/frictional_footing.hpp"
#include "scarp/fault/given_ground.hpp"
#include "scarp/fault/ground.hpp"
#include "scarp/fault/ground_levels.hpp"
#include "scarp/fault/layered_ground.hpp"
#include "scarp/fault/level_ground.hpp"
#include "scarp/fault/normal_fault.hpp"
#include "scarp/fault/reverse_fault.hpp"
#include "scarp/fault/shared_slip.hpp"
#include "scarp/fault/sticking_footing.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "scarp/fault/tapered_slip.hpp"

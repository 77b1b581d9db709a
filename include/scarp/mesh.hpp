// SPDX-License-Identifier: BSL-1.0
/// \file
/// Meshes of one kind of element with named regions and boundaries, and generators of simple ones.
/// `mesh.hpp` holds the type and checks it; `box_mesh.hpp` divides a grid into any element.
/// `pattern_grid.hpp` puts triangles or quadrilaterals of a pattern between grid lines, `jittered_grid.hpp` moves their
/// nodes. `mid_side_nodes.hpp` makes quadratic elements from straight ones; `joined_meshes.hpp` joins meshes where they
/// touch. `mesh_checks.hpp` looks for duplicate and hanging nodes. Files are read and written by the room io/gmsh.
/// Coordinates in metres, numbers from 0.
#pragma once

#include "scarp/mesh/box_mesh.hpp"
#include "scarp/mesh/graded_lines.hpp"
#include "scarp/mesh/jittered_grid.hpp"
#include "scarp/mesh/joined_meshes.hpp"
#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/mesh_checks.hpp"
#include "scarp/mesh/mid_side_nodes.hpp"
#include "scarp/mesh/outer_facets.hpp"
#include "scarp/mesh/pattern.hpp"
#include "scarp/mesh/pattern_grid.hpp"
#include "scarp/mesh/rectangle_mesh.hpp"
#include "scarp/mesh/straight_facets.hpp"

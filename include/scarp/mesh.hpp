// SPDX-License-Identifier: BSL-1.0
/// \file
/// Meshes of one kind of element with named regions and boundaries, and generators of simple ones.
/// `mesh.hpp` holds the type and checks it; `box_mesh.hpp` divides a grid into any element.
/// `mid_side_nodes.hpp` makes quadratic elements from straight ones.
/// Files are read and written by the room io/gmsh.
/// Coordinates in metres, numbers from 0.
#pragma once

#include "scarp/mesh/box_mesh.hpp"
#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/mid_side_nodes.hpp"
#include "scarp/mesh/rectangle_mesh.hpp"

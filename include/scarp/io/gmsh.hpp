// SPDX-License-Identifier: BSL-1.0
/// \file
/// Meshes from and to Gmsh's files, versions 2.2 and 4.1, text and binary.
/// Physical groups become regions (of the mesh's dimension) and boundaries (one below).
/// Elements are turned the right way round; nodes that nothing uses are dropped.
/// What does not fit is refused with file, line and the name of the group.
/// `gmsh_element_type.hpp` tells which element a file holds.
#pragma once

#include "scarp/io/gmsh/gmsh_element_type.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "scarp/io/gmsh/gmsh_writer.hpp"

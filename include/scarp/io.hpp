// SPDX-License-Identifier: BSL-1.0
/// \file
/// Files: tables, JSON lines, VTU and PVD for ParaView, checkpoints.
/// Whatever is written appears whole or not at all (`atomic_file.hpp`); logs grow line by line.
/// `folder_lock.hpp` keeps a folder for one writer.
/// `state_bits.hpp` turns any described state into bytes and back.
/// Rooms within: io/gmsh for meshes, io/packings for packings.
/// Errors name file and line.
#pragma once

#include "scarp/io/atomic_file.hpp"
#include "scarp/io/checkpoint_files.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/io/csv_reader.hpp"
#include "scarp/io/folder_lock.hpp"
#include "scarp/io/json_lines.hpp"
#include "scarp/io/mesh_tables.hpp"
#include "scarp/io/pvd.hpp"
#include "scarp/io/state_bits.hpp"
#include "scarp/io/state_text.hpp"
#include "scarp/io/vtu.hpp"

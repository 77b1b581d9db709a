// SPDX-License-Identifier: BSL-1.0
/// \file
/// Packings from and to files: own binary files, and tables of grains and contacts as other codes write them.
/// `packing_file.hpp` keeps every bit, `packing_tables.hpp` writes CSV for people.
/// `packing_reader.hpp` and `contact_reader.hpp` take tables of SudoDEM and Yade.
/// Above the room dem, since a packing is made of its types.
/// Errors name file, line and column.
#pragma once

#include "scarp/io/packings/contact_reader.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "scarp/io/packings/packing_reader.hpp"
#include "scarp/io/packings/packing_tables.hpp"

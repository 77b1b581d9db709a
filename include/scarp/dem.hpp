// SPDX-License-Identifier: BSL-1.0
/// \file
/// Packings of grains in a periodic cell: preparation, near pairs, time stepping, paths of strain and stress.
/// `packing.hpp` is a packing, `cloud.hpp` and the gradings throw grains, `preparation.hpp` consolidates them.
/// `drive.hpp` moves the cell along a given strain, `loading.hpp` holds stresses at the same time.
/// Any shape goes with any contact law; a packing stores what its law names and no more.
/// Stresses and tangents of a packing: room homogenise.
#pragma once

#include "scarp/dem/bonded_packing.hpp"
#include "scarp/dem/cell.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/clump_grading.hpp"
#include "scarp/dem/contacts.hpp"
#include "scarp/dem/critical_step.hpp"
#include "scarp/dem/damping.hpp"
#include "scarp/dem/disc_grading.hpp"
#include "scarp/dem/drive.hpp"
#include "scarp/dem/ellipse_grading.hpp"
#include "scarp/dem/grain_view.hpp"
#include "scarp/dem/loading.hpp"
#include "scarp/dem/loading_paths.hpp"
#include "scarp/dem/local_damping.hpp"
#include "scarp/dem/mirrored.hpp"
#include "scarp/dem/packing.hpp"
#include "scarp/dem/packing_picture.hpp"
#include "scarp/dem/population.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/dem/sphere_grading.hpp"
#include "scarp/dem/stability_limit.hpp"
#include "scarp/dem/superellipse_grading.hpp"
#include "scarp/dem/time_stepping.hpp"

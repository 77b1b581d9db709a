// SPDX-License-Identifier: BSL-1.0
/// \file
/// Shapes of grains: discs, ellipses, superellipses, spheres and clumps of them.
/// A shape is one header and models `ParticleShape`: it finds overlap, normal and arms of a touching pair.
/// Convex shapes with a support function get all that from `support_touch.hpp`.
/// Lengths in metres, in the frame of the packing.
/// Masses and contact laws live elsewhere.
#pragma once

#include "scarp/shape/checked_shape.hpp"
#include "scarp/shape/clump.hpp"
#include "scarp/shape/clump_templates.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/particle_shape.hpp"
#include "scarp/shape/settled_touch.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/shape/superellipse.hpp"
#include "scarp/shape/support_touch.hpp"

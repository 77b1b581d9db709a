// SPDX-License-Identifier: BSL-1.0
/// \file
/// The boundary-value problem without its material: kinematics, integration, assembly, constraints, loads, interfaces.
/// `discretisation.hpp` takes an element, a motion (small strain, updated Lagrangian) and an integration (full, B-bar).
/// Loads and constraints follow a course over the load factor.
/// An interface lets a rigid or meshed body stand on the ground.
/// Degrees of freedom are numbered dim * node + axis.
#pragma once

#include "scarp/bvp/attachment.hpp"
#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/describe_dof.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/field_error.hpp"
#include "scarp/bvp/following_pressure.hpp"
#include "scarp/bvp/integration.hpp"
#include "scarp/bvp/interface.hpp"
#include "scarp/bvp/kinematics.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/bvp/loads.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/bvp/point_by_point.hpp"
#include "scarp/bvp/rigid_body.hpp"
#include "scarp/bvp/standing_body.hpp"
#include "scarp/bvp/time_function.hpp"
#include "scarp/bvp/usual_integration.hpp"

// SPDX-License-Identifier: BSL-1.0
/// \file
/// Laws of touching surfaces: force and moment from overlap, slip and rotation.
/// A law is one header, an aggregate that models `ContactLaw` and says what it needs of a pair.
/// Members around a law add rolling resistance or a cohesive bond.
/// Between grains stiffness is in N/m, on interfaces (room bvp) in Pa/m.
/// The same source serves a number and a pack of numbers.
#pragma once

#include "scarp/contact/checked_contact_law.hpp"
#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/contact_law.hpp"
#include "scarp/contact/coulomb.hpp"
#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/law_checks.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/contact/rolling_resistance.hpp"

// SPDX-License-Identifier: BSL-1.0
/// \file
/// Constitutive providers: what answers with stress and tangent at an integration point.
/// `constitutive_provider.hpp` has the concept. `dem_rve.hpp` is a packing, `mohr_coulomb.hpp` a formula.
/// Adaptors hold another provider: dormant, lazy, recorded, varied from point to point, with a stiffness floor.
/// `nonlocal.hpp` gives any provider an intrinsic length.
/// Increments are displacement gradients from the committed state, stress in Pa.
#pragma once

#include "scarp/constitutive/any_provider.hpp"
#include "scarp/constitutive/checked_provider.hpp"
#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/dormant.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/lazy.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/nonlocal.hpp"
#include "scarp/constitutive/packing_in.hpp"
#include "scarp/constitutive/packings_by_depth.hpp"
#include "scarp/constitutive/perturbation_tangent.hpp"
#include "scarp/constitutive/random_packings.hpp"
#include "scarp/constitutive/recorded.hpp"
#include "scarp/constitutive/rve_quantities.hpp"
#include "scarp/constitutive/softening_strength.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/constitutive/strength.hpp"
#include "scarp/constitutive/varied_parameters.hpp"

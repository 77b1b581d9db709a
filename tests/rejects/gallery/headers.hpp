// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/bvp/interface.hpp"
#include "scarp/bvp/standing_body.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/law_per_species.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/random_packings.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/with_species.hpp"

// SPDX-License-Identifier: BSL-1.0
/// \file
/// What a packing says of itself as a continuum: stress, tangent, fabric, coordination, balance, energies.
/// Love and Weber's stress is positive in tension; tangents are of the co-rotated Cauchy stress.
/// Tangents: by uniform strain, condensed over all grains, aware of sliding contacts.
/// Nothing here changes a packing.
/// Sources are named beside each formula.
#pragma once

#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/condensed_tangent.hpp"
#include "scarp/homogenise/contact_tangent.hpp"
#include "scarp/homogenise/coordination.hpp"
#include "scarp/homogenise/energy_ledger.hpp"
#include "scarp/homogenise/fabric.hpp"
#include "scarp/homogenise/kinetic_stress.hpp"
#include "scarp/homogenise/non_affine.hpp"
#include "scarp/homogenise/sliding_aware_tangent.hpp"

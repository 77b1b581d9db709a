// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <type_traits>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/mid_sides.hpp"

namespace scarp {

/// The integration that an element takes where nobody says otherwise, so that it neither locks nor has free motions
/// that spread: reduced for quadratic quadrilaterals and hexahedra, the mean dilatation for linear ones, full for
/// simplices.
template <ReferenceElement Element>
using UsualIntegration = std::conditional_t<!GivesReducedQuadrature<Element>, FullIntegration,
                                            std::conditional_t<HasMidSides<Element>, ReducedIntegration, BBar>>;

/// Updated Lagrangian elements with that integration.
template <ReferenceElement Element>
using UsualGrid = Discretisation<Element, UpdatedLagrangian, UsualIntegration<Element>>;

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <type_traits>

#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/mid_sides.hpp"

namespace scarp {

/// The default integration of an element, chosen so that it neither locks nor has free motions
/// that spread: reduced for quadratic quadrilaterals and hexahedra, the mean dilatation for linear ones, full for
/// simplices.
template <CheckedElement Element>
using DefaultIntegration =
    std::conditional_t<!GivesReducedQuadrature<Element>, FullIntegration,
                       std::conditional_t<HasMidSides<Element> || PlacesNodes<Element>, ReducedIntegration, BBar>>;

}  // namespace scarp

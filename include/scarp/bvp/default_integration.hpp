// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <type_traits>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/mid_sides.hpp"
#ifdef SCARP_PRECOMPILED
#include "scarp/element/quad4.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/element/tri6.hpp"
#endif

namespace scarp {

/// The default integration of an element, chosen so that it neither locks nor has free motions
/// that spread: reduced for quadratic quadrilaterals and hexahedra, the mean dilatation for linear ones, full for
/// simplices.
template <CheckedElement Element>
using DefaultIntegration =
    std::conditional_t<!GivesReducedQuadrature<Element>, FullIntegration,
                       std::conditional_t<HasMidSides<Element> || PlacesNodes<Element>, ReducedIntegration, BBar>>;

/// Updated Lagrangian elements with that integration.
template <CheckedElement Element>
using DefaultGrid = Discretisation<Element, UpdatedLagrangian, DefaultIntegration<Element>>;

#ifdef SCARP_PRECOMPILED
/// DECLARE: `extern template`, or `template` in the library.
#define SCARP_GRID(DECLARE, ELEMENT)           \
  DECLARE void validate(Mesh<ELEMENT> const&); \
  DECLARE class Discretisation<ELEMENT, UpdatedLagrangian, DefaultIntegration<ELEMENT>>;
SCARP_GRID(extern template, Tri3)
SCARP_GRID(extern template, Tri6)
SCARP_GRID(extern template, Quad4)
SCARP_GRID(extern template, Quad8)
#endif

}  // namespace scarp

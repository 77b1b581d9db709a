// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/bvp/discretisation.hpp"
#ifdef SCARP_PRECOMPILED
#include "scarp/element/quad4.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/element/tri6.hpp"
#endif

namespace scarp {

/// Updated Lagrangian elements with their default integration.
template <CheckedElement Element>
using DefaultGrid = Discretisation<Element>;

#ifdef SCARP_PRECOMPILED
/// DECLARE: `extern template`, or `template` in the library.
#define SCARP_GRID(DECLARE, ELEMENT)           \
  DECLARE void validate(Mesh<ELEMENT> const&); \
  DECLARE class Discretisation<ELEMENT>;
SCARP_GRID(extern template, Tri3)
SCARP_GRID(extern template, Tri6)
SCARP_GRID(extern template, Quad4)
SCARP_GRID(extern template, Quad8)
#endif

}  // namespace scarp

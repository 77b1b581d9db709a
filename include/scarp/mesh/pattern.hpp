// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string_view>

#include "scarp/core/error.hpp"
#include "scarp/mesh/mid_side_nodes.hpp"

namespace scarp {

/// How the rectangles of a grid become triangles or quadrilaterals. The directions of the sides matter: strain
/// localises along them.
enum class Pattern {
  crossed,  ///< four triangles around the centre; the default of grids; for quadrilaterals the same as `quads`
  left,     ///< two triangles, the diagonal rises to the left
  right,    ///< two triangles, the diagonal rises to the right
  quads,    ///< the rectangle itself
};

/// Word of a pattern in options and messages.
constexpr std::string_view name(Pattern pattern) {
  switch (pattern) {
    case Pattern::left: return "left";
    case Pattern::right: return "right";
    case Pattern::quads: return "quads";
    default: return "crossed";
  }
}

/// Elements that one cell of a grid becomes: a rectangle of the plane, or the box that it is the side of in space,
/// where tetrahedra divide it into six whatever the pattern.
/// \throws InputError for triangles of undivided rectangles, and for diagonals in anything but triangles
template <ReferenceElement Element>
int elements_per_cell(Pattern pattern) {
  constexpr int dim = Element::dim;
  constexpr bool simplex = LinearOf<Element>::nodes == dim + 1;
  if (dim == 2 && simplex && pattern == Pattern::quads) {
    reject(
        "triangles are requested in the pattern 'quads' (it does not divide the rectangles): use 'crossed', 'left' "
        "or 'right', or quadrilaterals");
  }
  if (!(dim == 2 && simplex) && (pattern == Pattern::left || pattern == Pattern::right)) {
    reject(
        "the pattern '{}' is requested with elements of {} nodes in {} dimensions (only triangles follow its "
        "diagonals): use 'quads', or triangles",
        name(pattern), Element::nodes, dim);
  }
  if constexpr (!simplex) return 1;
  if constexpr (dim == 3) return 6;
  return pattern == Pattern::crossed ? 4 : 2;
}

}  // namespace scarp

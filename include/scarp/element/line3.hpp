// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/detail/simplex_rule.hpp"
#include "scarp/element/line2.hpp"
#include "scarp/element/mid_sides.hpp"

namespace scarp {

/// Line from 0 to 1 with a node in its middle, quadratic shapes: the side of plane quadratic elements.
struct Line3 {
  using Linear = Line2;

  static constexpr int dim = 1;
  static constexpr int nodes = 3;
  static constexpr int vtk_cell_type = 21;
  static constexpr int gmsh_type = 8;
  static constexpr std::array<int, 3> gmsh_order{0, 1, 2};

  static constexpr std::array<std::array<int, 2>, 1> mid_sides() { return {{{0, 1}}}; }

  static ShapeValues<Line3> shape(Vector<1> const& xi) { return detail::quadratic_simplex<Line3>(xi); }

  static ShapeGradients<Line3> shape_gradients(Vector<1> const& xi) {
    return detail::quadratic_simplex_gradients<Line3>(xi);
  }

  /// Two Gauss points: exact for a traction that varies linearly along a straight side.
  static auto quadrature() { return simplex_rule<1, 3>(); }
};

static_assert(ReferenceCell<Line3> && HasMidSides<Line3> && HasGmshType<Line3>);

}  // namespace scarp

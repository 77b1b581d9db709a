// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/reference_element.hpp"

namespace scarp {

/// Straight line from 0 to 1 with two nodes: the side of plane elements.
struct Line2 {
  static constexpr int dim = 1;
  static constexpr int nodes = 2;
  static constexpr int vtk_cell_type = 3;
  static constexpr int gmsh_type = 1;
  static constexpr std::array<int, 2> gmsh_order{0, 1};

  static ShapeValues<Line2> shape(Vector<1> const& xi) { return {1.0 - xi(0), xi(0)}; }

  static ShapeGradients<Line2> shape_gradients(Vector<1> const&) { return {-1.0, 1.0}; }

  /// Midpoint rule: exact for a constant traction on linear shapes.
  static std::array<QuadraturePoint<1>, 1> quadrature() { return {{{Vector<1>(0.5), 1.0}}}; }
};

static_assert(ReferenceCell<Line2> && HasGmshType<Line2>);

}  // namespace scarp

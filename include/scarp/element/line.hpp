// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/mid_sides.hpp"
#include "scarp/element/quadrature_rules.hpp"
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

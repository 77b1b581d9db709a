// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/line.hpp"
#include "scarp/element/tri3.hpp"

namespace scarp {

/// Triangle with corners as Tri3 and then the middles of its sides (0, 1), (1, 2), (2, 0), quadratic shapes.
struct Tri6 : detail::OnSimplex<2> {
  using Facet = Line3;
  using Linear = Tri3;

  static constexpr int nodes = 6;
  static constexpr int facet_nodes = 3;
  static constexpr int vtk_cell_type = 22;
  static constexpr int gmsh_type = 9;
  static constexpr std::array<int, 6> gmsh_order{0, 1, 2, 3, 4, 5};

  static constexpr std::array<std::array<int, 2>, 3> mid_sides() { return {{{0, 1}, {1, 2}, {2, 0}}}; }

  static ShapeValues<Tri6> shape(Vector<2> const& xi) { return detail::quadratic_simplex<Tri6>(xi); }

  static ShapeGradients<Tri6> shape_gradients(Vector<2> const& xi) {
    return detail::quadratic_simplex_gradients<Tri6>(xi);
  }

  /// Three points: the stiffness of a triangle with straight sides is exact.
  static auto quadrature() { return rule<2>(); }

  static constexpr std::array<std::array<int, 3>, 3> facets() { return {{{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}}; }
};

static_assert(ReferenceElement<Tri6> && HasMidSides<Tri6> && HasGmshType<Tri6>);

}  // namespace scarp

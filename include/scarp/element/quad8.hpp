// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/line.hpp"
#include "scarp/element/quad4.hpp"

namespace scarp {

/// Square [-1, 1] x [-1, 1] with corners as Quad4 and then the middles of its sides (0, 1), (1, 2), (2, 3), (3, 0);
/// serendipity shapes (quadratic without \f$ \xi^2\eta^2 \f$).
struct Quad8 : detail::OnCube<2> {
  using Facet = Line3;
  using Linear = Quad4;

  static constexpr int nodes = 8;
  static constexpr int facet_nodes = 3;
  static constexpr int vtk_cell_type = 23;
  static constexpr int gmsh_type = 16;
  static constexpr std::array<int, 8> gmsh_order{0, 1, 2, 3, 4, 5, 6, 7};

  static constexpr std::array<std::array<int, 2>, 4> mid_sides() { return {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}}; }

  /// Axis that each of these sides runs along.
  static constexpr std::array<int, 4> mid_side_axes() { return {0, 1, 0, 1}; }

  static ShapeValues<Quad8> shape(Vector<2> const& xi) { return detail::serendipity<Quad8>(xi); }

  static ShapeGradients<Quad8> shape_gradients(Vector<2> const& xi) { return detail::serendipity_gradients<Quad8>(xi); }

  /// Three by three points: the stiffness of a parallelogram is exact.
  static auto quadrature() { return gauss_rule<2, 3>(); }

  /// Two by two points: one hourglass mode of a single element has no stiffness; two elements cannot share it.
  static auto reduced_quadrature() { return gauss_rule<2, 2>(); }

  static constexpr std::array<std::array<int, 3>, 4> facets() { return {{{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}}; }
};

static_assert(ReferenceElement<Quad8> && GivesReducedQuadrature<Quad8> && HasMidSides<Quad8> && HasGmshType<Quad8>);

}  // namespace scarp

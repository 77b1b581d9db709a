// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/hex8.hpp"
#include "scarp/element/quad8.hpp"

namespace scarp {

/// Cube [-1, 1]^3 with corners as Hex8 and then the middles of its edges: around the bottom, around the top, upwards;
/// serendipity shapes. Gmsh orders the edges by their corners' numbers.
struct Hex20 : detail::OnCube<3> {
  using Facet = Quad8;
  using Linear = Hex8;

  static constexpr int nodes = 20;
  static constexpr int facet_nodes = 8;
  static constexpr int vtk_cell_type = 25;
  static constexpr int gmsh_type = 17;
  static constexpr std::array<int, 20> gmsh_order{0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};

  static constexpr std::array<std::array<int, 2>, 12> mid_sides() {
    return {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  }

  /// Axis that each of these edges runs along.
  static constexpr std::array<int, 12> mid_side_axes() { return {0, 1, 0, 1, 0, 1, 0, 1, 2, 2, 2, 2}; }

  static ShapeValues<Hex20> shape(Vector<3> const& xi) { return detail::serendipity<Hex20>(xi); }

  static ShapeGradients<Hex20> shape_gradients(Vector<3> const& xi) { return detail::serendipity_gradients<Hex20>(xi); }

  /// Three points along each axis: the stiffness of a parallelepiped is exact.
  static auto quadrature() { return gauss_rule<3, 3>(); }

  /// Two points along each axis: six hourglass modes of a single element have no stiffness; a mesh cannot share them.
  static auto reduced_quadrature() { return gauss_rule<3, 2>(); }

  static constexpr std::array<std::array<int, 8>, 6> facets() {
    return {{{0, 3, 2, 1, 11, 10, 9, 8},
             {4, 5, 6, 7, 12, 13, 14, 15},
             {0, 1, 5, 4, 8, 17, 12, 16},
             {1, 2, 6, 5, 9, 18, 13, 17},
             {2, 3, 7, 6, 10, 19, 14, 18},
             {3, 0, 4, 7, 11, 16, 15, 19}}};
  }
};

static_assert(ReferenceElement<Hex20> && GivesReducedQuadrature<Hex20> && HasMidSides<Hex20> && HasGmshType<Hex20>);

}  // namespace scarp

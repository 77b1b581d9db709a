// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/tet4.hpp"
#include "scarp/element/tri6.hpp"

namespace scarp {

/// Tetrahedron with corners as Tet4 and then the middles of its edges (0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3),
/// quadratic shapes. Gmsh has the last two in the opposite order.
struct Tet10 : detail::OnSimplex<3> {
  using Facet = Tri6;
  using Linear = Tet4;

  static constexpr int nodes = 10;
  static constexpr int facet_nodes = 6;
  static constexpr int vtk_cell_type = 24;
  static constexpr int gmsh_type = 11;
  static constexpr std::array<int, 10> gmsh_order{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

  static constexpr std::array<std::array<int, 2>, 6> mid_sides() {
    return {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  }

  static ShapeValues<Tet10> shape(Vector<3> const& xi) { return detail::quadratic_simplex<Tet10>(xi); }

  static ShapeGradients<Tet10> shape_gradients(Vector<3> const& xi) {
    return detail::quadratic_simplex_gradients<Tet10>(xi);
  }

  /// Four points: the stiffness of a tetrahedron with straight edges is exact.
  static auto quadrature() { return rule<2>(); }

  static constexpr std::array<std::array<int, 6>, 4> facets() {
    return {{{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {0, 3, 2, 7, 9, 6}}};
  }
};

static_assert(ReferenceElement<Tet10> && HasMidSides<Tet10> && HasGmshType<Tet10>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/tri3.hpp"

namespace scarp {

/// Tetrahedron with corners at the origin and the three unit points, linear shapes: strain and stress are constant.
struct Tet4 : detail::OnSimplex<3> {
  using Facet = Tri3;

  static constexpr int nodes = 4;
  static constexpr int facet_nodes = 3;
  static constexpr int vtk_cell_type = 10;
  static constexpr int gmsh_type = 4;
  static constexpr std::array<int, 4> gmsh_order{0, 1, 2, 3};

  static ShapeValues<Tet4> shape(Vector<3> const& xi) { return {1.0 - xi.sum(), xi(0), xi(1), xi(2)}; }

  static ShapeGradients<Tet4> shape_gradients(Vector<3> const&) {
    ShapeGradients<Tet4> gradients;
    gradients << -1.0, -1.0, -1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0;
    return gradients;
  }

  /// Centroid: the stiffness of the constant strain is exact.
  static auto quadrature() { return rule<1>(); }

  static constexpr std::array<std::array<int, 3>, 4> facets() { return {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}}; }
};

static_assert(ReferenceElement<Tet4> && HasGmshType<Tet4>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/quad4.hpp"

namespace scarp {

/// Cube [-1, 1]^3, nodes counter-clockwise (seen from above) around the bottom from (-1, -1, -1), then around the top,
/// trilinear shapes \f$ N_a = (1 + \xi_a \xi)(1 + \eta_a \eta)(1 + \zeta_a \zeta)/8 \f$.
struct Hex8 : detail::OnCube<3> {
  using Facet = Quad4;

  static constexpr int nodes = 8;
  static constexpr int facet_nodes = 4;
  static constexpr int vtk_cell_type = 12;
  static constexpr int gmsh_type = 5;
  static constexpr std::array<int, 8> gmsh_order{0, 1, 2, 3, 4, 5, 6, 7};

  /// The square's shapes in every level times the line's between bottom and top.
  static ShapeValues<Hex8> shape(Vector<3> const& xi) {
    auto const level = Quad4::shape(xi.head<2>());
    ShapeValues<Hex8> shape;
    shape << level * (1.0 - xi(2)) / 2.0, level * (1.0 + xi(2)) / 2.0;
    return shape;
  }

  static ShapeGradients<Hex8> shape_gradients(Vector<3> const& xi) {
    auto const level = Quad4::shape(xi.head<2>());
    auto const slopes = Quad4::shape_gradients(xi.head<2>());
    ShapeGradients<Hex8> gradients;
    gradients << slopes * (1.0 - xi(2)) / 2.0, -level / 2.0, slopes * (1.0 + xi(2)) / 2.0, level / 2.0;
    return gradients;
  }

  /// Two points along each axis: the stiffness of a parallelepiped is exact.
  static auto quadrature() { return gauss_rule<3, 2>(); }

  /// One point: twelve hourglass modes of a single element have no stiffness.
  static auto reduced_quadrature() { return gauss_rule<3, 1>(); }

  static constexpr std::array<std::array<int, 4>, 6> facets() {
    return {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  }
};

static_assert(ReferenceElement<Hex8> && GivesReducedQuadrature<Hex8> && HasGmshType<Hex8>);

}  // namespace scarp

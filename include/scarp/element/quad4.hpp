// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/index.hpp"
#include "scarp/element/line.hpp"
#include "scarp/element/quadrature_rules.hpp"

namespace scarp {

/// Square [-1, 1] x [-1, 1], nodes counter-clockwise from (-1, -1), bilinear shapes
/// \f$ N_a = (1 + \xi_a \xi)(1 + \eta_a \eta)/4 \f$.
struct Quad4 : detail::OnCube<2> {
  using Facet = Line2;

  static constexpr int nodes = 4;
  static constexpr int facet_nodes = 2;
  static constexpr int vtk_cell_type = 9;
  static constexpr int gmsh_type = 3;
  static constexpr std::array<int, 4> gmsh_order{0, 1, 2, 3};

  static ShapeValues<Quad4> shape(Vector<2> const& xi) {
    ShapeValues<Quad4> shape;
    for (int a = 0; a < nodes; ++a) {
      auto const [c, d] = signs[detail::index(a)];
      shape(a) = (1.0 + c * xi(0)) * (1.0 + d * xi(1)) / 4.0;
    }
    return shape;
  }

  static ShapeGradients<Quad4> shape_gradients(Vector<2> const& xi) {
    ShapeGradients<Quad4> gradients;
    for (int a = 0; a < nodes; ++a) {
      auto const [c, d] = signs[detail::index(a)];
      gradients(a, 0) = c * (1.0 + d * xi(1)) / 4.0;
      gradients(a, 1) = d * (1.0 + c * xi(0)) / 4.0;
    }
    return gradients;
  }

  /// Two by two points: the stiffness of a parallelogram is exact.
  static auto quadrature() { return gauss_rule<2, 2>(); }

  /// One point: two hourglass modes of a single element have no stiffness.
  static auto reduced_quadrature() { return gauss_rule<2, 1>(); }

  static constexpr std::array<std::array<int, 2>, 4> facets() { return {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}}; }

 private:
  /// Signs of the nodes' coordinates.
  static constexpr std::array<std::array<double, 2>, 4> signs{{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}};
};

static_assert(ReferenceElement<Quad4> && GivesReducedQuadrature<Quad4> && HasGmshType<Quad4>);

}  // namespace scarp

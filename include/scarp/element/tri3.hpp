// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/line.hpp"
#include "scarp/element/quadrature_rules.hpp"

namespace scarp {

/// Triangle with corners (0, 0), (1, 0), (0, 1), counter-clockwise, linear shapes: strain and stress are constant.
struct Tri3 : detail::OnSimplex<2> {
  using Facet = Line2;

  static constexpr int nodes = 3;
  static constexpr int facet_nodes = 2;
  static constexpr int vtk_cell_type = 5;
  static constexpr int gmsh_type = 2;
  static constexpr std::array<int, 3> gmsh_order{0, 1, 2};

  static ShapeValues<Tri3> shape(Vector<2> const& xi) { return {1.0 - xi(0) - xi(1), xi(0), xi(1)}; }

  static ShapeGradients<Tri3> shape_gradients(Vector<2> const&) {
    ShapeGradients<Tri3> gradients;
    gradients << -1.0, -1.0, 1.0, 0.0, 0.0, 1.0;
    return gradients;
  }

  /// Centroid: the stiffness of the constant strain is exact.
  static auto quadrature() { return rule<1>(); }

  static constexpr std::array<std::array<int, 2>, 3> facets() { return {{{0, 1}, {1, 2}, {2, 0}}}; }
};

static_assert(ReferenceElement<Tri3> && HasGmshType<Tri3>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/element/mid_sides.hpp"

namespace scarp {

/// Coordinates [m] of a cell's nodes in a space of `Space` dimensions, shape (nodes, Space).
template <class Cell, int Space>
using Corners = Eigen::Matrix<double, Cell::nodes, Space>;

/// The rows of `nodes` [m] that a cell's node numbers name.
template <class Cell, int Space>
Corners<Cell, Space> corners(std::array<int, Cell::nodes> const& numbers, std::vector<Vector<Space>> const& nodes) {
  Corners<Cell, Space> rows;
  for (int a = 0; a < Cell::nodes; ++a) {
    rows.row(a) = nodes[detail::index(numbers[detail::index(a)])].transpose();
  }
  return rows;
}

/// \f$ J_{ij} = \partial x_i / \partial \xi_j \f$ [m], shape (Space, Cell::dim).
template <class Cell, int Space>
Eigen::Matrix<double, Space, Cell::dim> jacobian(Corners<Cell, Space> const& corners, Vector<Cell::dim> const& xi) {
  return corners.transpose().lazyProduct(Cell::shape_gradients(xi));
}

/// Volume, area or length per unit of the reference cell. A cell that fills its space keeps the sign (negative: turned
/// inside out); the side of one has \f$ \sqrt{\det J^T J} \f$.
template <class Cell, int Space>
double measure(Corners<Cell, Space> const& corners, Vector<Cell::dim> const& xi) {
  auto const map = jacobian<Cell, Space>(corners, xi);
  if constexpr (Cell::dim == Space) {
    return map.determinant();
  } else {
    Tensor<Cell::dim> const metric = map.transpose() * map;
    return std::sqrt(metric.determinant());
  }
}

/// d det(A)^(2/d) / |A|^2 of the map A from a regular cell: 1 for a regular one, 0 without volume or inside out (Liu
/// and Joe 1994; Knupp 2001).
template <class Cell>
double mean_ratio(Corners<Cell, Cell::dim> const& corners, Vector<Cell::dim> const& xi) {
  constexpr int dim = Cell::dim;
  constexpr bool is_simplex = LinearOf<Cell>::nodes == dim + 1;
  Tensor<dim> const map = jacobian<Cell, dim>(corners, xi);
  // Scalar products of the edges of a regular cell: of unit length, in simplices at 60 degrees.
  Tensor<dim> edges = Tensor<dim>::Identity();
  if (is_simplex) edges = (edges + Tensor<dim>::Ones()) / 2.0;
  double const volume = map.determinant() / std::sqrt(edges.determinant());
  return volume > 0.0 ? dim * std::pow(volume, 2.0 / dim) / (map * edges.inverse() * map.transpose()).trace() : 0.0;
}

/// Shape-function derivatives with respect to space [1/m], shape (nodes, dim), and the volume [m^dim] of one
/// integration point; both are meaningless when the volume is not positive.
template <ReferenceElement Element>
struct SpatialShape {
  ShapeGradients<Element> gradients = ShapeGradients<Element>::Zero();  ///< [1/m], shape (nodes, dim)
  double volume = 0.0;  ///< [m^dim]; not positive where the element is turned inside out
};

/// Shape gradients and volume of an integration point, given the places of the element's nodes [m].
template <ReferenceElement Element>
SpatialShape<Element> spatial_shape(Corners<Element, Element::dim> const& corners,
                                    QuadraturePoint<Element::dim> const& point) {
  ShapeGradients<Element> const local = Element::shape_gradients(point.xi);
  Tensor<Element::dim> const map = corners.transpose().lazyProduct(local);
  return {local.lazyProduct(map.inverse()), point.weight * map.determinant()};
}

}  // namespace scarp

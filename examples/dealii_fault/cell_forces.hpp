// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <span>

#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/quad4.hpp"

/// Strains and forces of one cell of another program, by its shape functions: bilinear ones with the mean dilatation, others pointwise.
namespace dealii_fault {

constexpr int cell_points = 4;
using scarp::Gradient;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, 9, 2>;  ///< shape (nodes, 2)
using Stresses = std::array<scarp::VoigtStress<2>, cell_points>;
using Tangents = std::array<scarp::VoigtTangent<2>, cell_points>;
using Motion = scarp::UpdatedLagrangian;

struct Shape {
  Rows gradients;       ///< of the shape functions [1/m]
  double volume = 0.0;  ///< [m3]
};
using Shapes = std::array<Shape, cell_points>;

/// After displacements [m] of the nodes; volumes that are not positive belong to a cell turned inside out.
inline Shapes moved(Shapes shapes, Rows const& displacements) {
  for (auto& [gradients, volume] : shapes) {
    scarp::Tensor<2> const stretch = scarp::Tensor<2>::Identity() + displacements.transpose() * gradients;
    gradients = (gradients * stretch.inverse()).eval();
    volume *= stretch.determinant();
  }
  return shapes;
}

inline scarp::ElementShapes<scarp::Quad4, cell_points> bilinear(Shapes const& shapes) {
  scarp::ElementShapes<scarp::Quad4, cell_points> same;
  for (std::size_t p = 0; p < cell_points; ++p) same[p] = {shapes[p].gradients, shapes[p].volume};
  return same;
}

/// Displacement gradients of the points for moves [m] of the nodes from where the shapes are.
inline std::array<Gradient<2>, cell_points> gradients(Shapes const& shapes, Rows const& moves) {
  if (moves.rows() == scarp::Quad4::nodes)
    return scarp::BBar::gradients<Motion>(bilinear(shapes), scarp::Corners<scarp::Quad4, 2>(moves));
  std::array<Gradient<2>, cell_points> all;
  for (std::size_t p = 0; p < cell_points; ++p) all[p] = moves.transpose() * shapes[p].gradients;
  return all;
}

/// Nodal forces [N], shape (nodes, 2).
inline Rows forces(Shapes const& shapes, Stresses const& stresses) {
  if (shapes[0].gradients.rows() == scarp::Quad4::nodes)
    return scarp::BBar::forces<scarp::Quad4>(bilinear(shapes), std::span(stresses));
  Rows sum = Rows::Zero(shapes[0].gradients.rows(), 2);
  for (std::size_t p = 0; p < cell_points; ++p)
    sum += shapes[p].volume * shapes[p].gradients * scarp::from_voigt_stress<2, double>(stresses[p]);
  return sum;
}

/// Their derivative by the displacements [N/m], numbered 2 * node + axis.
inline Eigen::MatrixXd stiffness(Shapes const& shapes, Stresses const& stresses, Tangents const& tangents) {
  auto const nodes = shapes[0].gradients.rows();
  if (nodes == scarp::Quad4::nodes)
    return scarp::BBar::stiffness<Motion>(bilinear(shapes), std::span(stresses), std::span(tangents));
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes);
  for (std::size_t p = 0; p < cell_points; ++p) {
    for (Eigen::Index column = 0; column < 2 * nodes; ++column) {
      Gradient<2> further = Gradient<2>::Zero();
      further.row(column % 2) = shapes[p].gradients.row(column / 2);
      auto const flux = Motion::flux_change<2>(further, stresses[p], tangents[p]);
      Rows const change = shapes[p].volume * shapes[p].gradients * flux.transpose();
      matrix.col(column) += change.transpose().reshaped();
    }
  }
  return matrix;
}

}  // namespace dealii_fault

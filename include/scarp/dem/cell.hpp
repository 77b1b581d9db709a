// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "scarp/tensor/tensor.hpp"

namespace scarp {

/// Smallest distance between opposite faces of the cell [m].
template <int Dim>
double min_height(Tensor<Dim> const& cell) {
  Tensor<Dim> const normals = cell.inverse();
  return 1.0 / std::sqrt(normals.rowwise().squaredNorm().maxCoeff());
}

/// Integer matrix U of determinant 1 such that the columns of cell x U are pairwise reduced: no base vector gets
/// shorter by adding another one. In 2D this is Lagrange's and Gauss's reduction. A cell that needs none gives the
/// identity.
template <int Dim>
Eigen::Matrix<int, Dim, Dim> lattice_reduction(Tensor<Dim> cell) {
  Eigen::Matrix<int, Dim, Dim> change = Eigen::Matrix<int, Dim, Dim>::Identity();
  // A ratio of exactly one half would alternate without end: require a little more before changing anything.
  constexpr double half = 0.5 + 1e-9;
  for (bool reduced = false; !reduced;) {
    reduced = true;
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j) {
        if (i == j) continue;
        double const ratio = cell.col(i).dot(cell.col(j)) / cell.col(j).squaredNorm();
        if (!(std::abs(ratio) > half) || std::abs(ratio) > 1e6) continue;
        int const multiple = static_cast<int>(std::lround(ratio));
        cell.col(i) -= multiple * cell.col(j);
        change.col(i) -= multiple * change.col(j);
        reduced = false;
      }
    }
  }
  return change;
}

}  // namespace scarp

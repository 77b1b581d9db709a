// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/QR>

#include "scarp/tensor/tensor.hpp"

namespace scarp::detail {

/// Of a square system that may be singular; pivots below 1e-9 of the largest count as zero. One size of matrices for all dimensions compiles
/// faster.
inline Eigen::VectorXd least_norm_solution(Eigen::MatrixXd const& matrix, Eigen::VectorXd const& right) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors;
  factors.setThreshold(1e-9);
  factors.compute(matrix);
  return factors.solve(right);
}

}  // namespace scarp::detail

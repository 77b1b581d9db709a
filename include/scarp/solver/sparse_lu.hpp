// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseLU>

#include "scarp/core/status.hpp"

namespace scarp {

/// Direct solver for unsymmetric sparse systems (Eigen's supernodal LU with column ordering). The ordering is kept as
/// long as the matrix keeps its size.
class SparseLu {
 public:
  /// \return failed / singular_system, or not_finite when the matrix holds NaN
  Verdict factorize(Eigen::SparseMatrix<double> const& matrix) {
    if (!matrix.coeffs().allFinite()) return {Status::failed, Reason::not_finite};
    if (matrix.rows() != rows_ || matrix.nonZeros() != entries_) {
      solver_.analyzePattern(matrix);
      rows_ = matrix.rows();
      entries_ = matrix.nonZeros();
    }
    solver_.factorize(matrix);
    if (solver_.info() != Eigen::Success) return {Status::failed, Reason::singular_system};
    return {};
  }

  Eigen::VectorXd solve(Eigen::VectorXd const& right) const { return solver_.solve(right); }

 private:
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver_;
  Eigen::Index rows_ = -1;
  Eigen::Index entries_ = -1;
};

}  // namespace scarp

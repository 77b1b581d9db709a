// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/UmfPackSupport>

#include "scarp/solver/linear_solver.hpp"

namespace scarp {

/// Direct solver for unsymmetric systems (SuiteSparse's multifrontal UMFPACK); needs the component `scarp::suitesparse`.
class Umfpack {
 public:
  Verdict factorize(SparseMatrix const& matrix) {
    matrix_ = matrix;  // which the solver goes on reading when it solves
    transposed_is_ready_ = false;
    return detail::factorize_with(solver_, pattern_, matrix_);
  }
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const { return solver_.solve(right); }
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const {
    if (!transposed_is_ready_) {
      transposed_matrix_ = matrix_.transpose();
      transposed_.compute(transposed_matrix_);
    }
    transposed_is_ready_ = true;
    return transposed_.solve(right);
  }

 private:
  Eigen::UmfPackLU<SparseMatrix> solver_;
  detail::PatternMemory pattern_;
  SparseMatrix matrix_;
  mutable SparseMatrix transposed_matrix_;
  mutable Eigen::UmfPackLU<SparseMatrix> transposed_;
  mutable bool transposed_is_ready_ = false;
};

static_assert(LinearSolver<Umfpack>);

}  // namespace scarp

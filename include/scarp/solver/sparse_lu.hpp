// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseLU>

#include "scarp/solver/linear_solver.hpp"

namespace scarp {

/// Direct solver for unsymmetric sparse systems (Eigen's supernodal LU with column ordering).
class SparseLu {
 public:
  Verdict factorize(SparseMatrix const& matrix) { return detail::factorize_with(solver_, pattern_, matrix); }
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const { return solver_.solve(right); }
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const { return solver_.transpose().solve(right); }

 private:
  // Eigen's solver hands out its transposed view from a non-const object only.
  mutable Eigen::SparseLU<SparseMatrix> solver_;
  detail::PatternMemory pattern_;
};

static_assert(LinearSolver<SparseLu>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseLU>

#include "scarp/core/precompiled.hpp"
#include "scarp/solver/linear_solver.hpp"

namespace scarp {

/// Direct solver for unsymmetric sparse systems (Eigen's supernodal LU with column ordering).
class SCARP_EXPORT SparseLu {
 public:
  Verdict factorize(SparseMatrix const& matrix);
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const;
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const;

 private:
  // Eigen's solver hands out its transposed view from a non-const object only.
  mutable Eigen::SparseLU<SparseMatrix> solver_;
  detail::PatternMemory pattern_;
};

static_assert(LinearSolver<SparseLu>);

#ifndef SCARP_PRECOMPILED
#define SCARP_SPARSE_LU_DEFINITIONS inline
#endif
#ifdef SCARP_SPARSE_LU_DEFINITIONS  // empty in the library that contains them
SCARP_SPARSE_LU_DEFINITIONS Verdict SparseLu::factorize(SparseMatrix const& matrix) {
  return detail::factorize_with(solver_, pattern_, matrix);
}

SCARP_SPARSE_LU_DEFINITIONS Eigen::VectorXd SparseLu::solve(Eigen::VectorXd const& right) const {
  return solver_.solve(right);
}

SCARP_SPARSE_LU_DEFINITIONS Eigen::VectorXd SparseLu::solve_transposed(Eigen::VectorXd const& right) const {
  return solver_.transpose().solve(right);
}
#endif
#undef SCARP_SPARSE_LU_DEFINITIONS

}  // namespace scarp

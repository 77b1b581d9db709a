// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseLU>

#include "scarp/core/precompiled.hpp"
#include "scarp/solver/linear_solver.hpp"

namespace scarp {

/// Direct solver for unsymmetric sparse systems (Eigen's supernodal LU with column ordering).
class SCARP_EXPORT SparseLu {
 public:
  /// The ordering is reused while the pattern stays.
  /// \return singular_system or not_finite where there are no factors
  Verdict factorize(SparseMatrix const& matrix);
  /// Solves A x = right after an acceptable factorisation.
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const;
  /// Solves \f$ A^T x = right \f$ after an acceptable factorisation.
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const;

 private:
  // Eigen's solver hands out its transposed view from a non-const object only.
  mutable Eigen::SparseLU<SparseMatrix> solver_;
  detail::PatternMemory pattern_;
};

static_assert(LinearSolver<SparseLu>);

#ifdef SCARP_DEFINITIONS
SCARP_DEFINITIONS Verdict SparseLu::factorize(SparseMatrix const& matrix) {
  return detail::factorize_with(solver_, pattern_, matrix);
}

SCARP_DEFINITIONS Eigen::VectorXd SparseLu::solve(Eigen::VectorXd const& right) const { return solver_.solve(right); }

SCARP_DEFINITIONS Eigen::VectorXd SparseLu::solve_transposed(Eigen::VectorXd const& right) const {
  return solver_.transpose().solve(right);
}
#endif

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCholesky>

#include "scarp/solver/linear_solver.hpp"

namespace scarp {

/// Direct solver for symmetric sparse systems (Eigen's simplicial LDLT), also indefinite ones that need no pivoting. Only the lower
/// triangle is read: of an unsymmetric matrix it solves another system, which the residual tells.
class SparseLdlt {
 public:
  Verdict factorize(SparseMatrix const& matrix) { return detail::factorize_with(solver_, pattern_, matrix); }
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const { return solver_.solve(right); }
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const { return solve(right); }

 private:
  Eigen::SimplicialLDLT<SparseMatrix> solver_;
  detail::PatternMemory pattern_;
};

static_assert(LinearSolver<SparseLdlt>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/CholmodSupport>

#include "scarp/solver/linear_solver.hpp"

namespace scarp {

/// Direct solver for symmetric positive definite systems (SuiteSparse's CHOLMOD, supernodal or simplicial as it sees fit); needs the
/// component `scarp::suitesparse`. A matrix that is not positive definite counts as singular.
class Cholmod {
 public:
  Verdict factorize(SparseMatrix const& matrix) { return detail::factorize_with(solver_, pattern_, matrix); }
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const { return solver_.solve(right); }
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const { return solve(right); }

 private:
  Eigen::CholmodDecomposition<SparseMatrix> solver_;
  detail::PatternMemory pattern_;
};

static_assert(LinearSolver<Cholmod>);

}  // namespace scarp

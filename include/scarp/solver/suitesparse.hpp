// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>
#include <limits>

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

namespace detail {

/// Eigen's interface, and UMFPACK's own solution of the transposed system from the same factors.
class UmfpackFactors : public Eigen::UmfPackLU<SparseMatrix> {
 public:
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const {
    Eigen::VectorXd solution(right.size());
    int const status =
        Eigen::umfpack_solve(UMFPACK_At, mp_matrix.outerIndexPtr(), mp_matrix.innerIndexPtr(), mp_matrix.valuePtr(),
                             solution.data(), right.data(), m_numeric, m_control.data(), m_umfpackInfo.data());
    if (status != UMFPACK_OK) solution.setConstant(std::numeric_limits<double>::quiet_NaN());
    return solution;
  }
};

}  // namespace detail

/// Direct solver for unsymmetric systems (SuiteSparse's multifrontal UMFPACK); needs the component `scarp::suitesparse`.
class Umfpack {
 public:
  Verdict factorize(SparseMatrix const& matrix) {
    matrix_ = matrix;  // which the solver goes on reading when it solves
    return detail::factorize_with(solver_, pattern_, matrix_);
  }
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const { return solver_.solve(right); }
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const { return solver_.solve_transposed(right); }

 private:
  detail::UmfpackFactors solver_;
  detail::PatternMemory pattern_;
  SparseMatrix matrix_;
};

static_assert(LinearSolver<Umfpack>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "scarp/core/precompiled.hpp"
#include "scarp/core/status.hpp"
#ifdef SCARP_DEFINITIONS
#include <Eigen/SparseLU>
#endif

namespace scarp {

using SparseMatrix = Eigen::SparseMatrix<double>;  ///< Compressed by columns, of double precision.

/// Solves systems of linear equations by the factors of their matrix.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// The matrix must outlive its factors.
  /// \return failed / singular_system or not_finite where there are no factors
  virtual Verdict factorize(SparseMatrix const& matrix) = 0;
  /// Solves A x = right after an acceptable factorisation.
  virtual Eigen::VectorXd solve(Eigen::VectorXd const& right) const = 0;
  /// Solves \f$ A^T x = right \f$ after an acceptable factorisation.
  virtual Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const = 0;
};

/// Makes a linear solver of a program's choice, such as `sparse_lu`.
using LinearSolverFactory = std::function<std::unique_ptr<LinearSolver>()>;

/// One of Eigen's direct solvers. The ordering is reused while the matrix keeps its pattern.
/// \tparam Factors such as `Eigen::UmfPackLU<SparseMatrix>`, or those of symmetric matrices. Factors without
/// transpose() solve the transposed system as if it were symmetric, which lowers the estimate of a condition number at
/// most.
template <class Factors>
class DirectSolver final : public LinearSolver {
 public:
  Verdict factorize(SparseMatrix const& matrix) override {
    if (!matrix.coeffs().allFinite()) return {Status::failed, Reason::not_finite};
    if (has_new_pattern(matrix)) factors_.analyzePattern(matrix);
    factors_.factorize(matrix);
    if (factors_.info() != Eigen::Success) return {Status::failed, Reason::singular_system};
    return {};
  }
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const override { return factors_.solve(right); }
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const override {
    if constexpr (requires { factors_.transpose(); }) {
      return factors_.transpose().solve(right);
    } else {
      return factors_.solve(right);
    }
  }

 private:
  /// Whether the pattern is another one than that of the last matrix, which it replaces.
  bool has_new_pattern(SparseMatrix const& matrix) {
    bool const same = matrix.rows() == rows_ && matrix.nonZeros() == static_cast<Eigen::Index>(inner_.size()) &&
                      std::equal(inner_.begin(), inner_.end(), matrix.innerIndexPtr()) &&
                      std::equal(outer_.begin(), outer_.end(), matrix.outerIndexPtr());
    if (same) return false;
    rows_ = matrix.rows();
    inner_.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
    outer_.assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize());
    return true;
  }

  mutable Factors factors_;  // SparseLU hands out its transposed view from a non-const object only
  Eigen::Index rows_ = -1;
  std::vector<int> inner_;
  std::vector<int> outer_;
};

/// A `LinearSolverFactory` of `DirectSolver`s.
template <class Factors>
std::unique_ptr<LinearSolver> direct_solver() {
  return std::make_unique<DirectSolver<Factors>>();
}

/// Solver of unsymmetric sparse systems: Eigen's supernodal LU with column ordering.
SCARP_EXPORT std::unique_ptr<LinearSolver> sparse_lu();

#ifdef SCARP_DEFINITIONS
SCARP_DEFINITIONS std::unique_ptr<LinearSolver> sparse_lu() { return direct_solver<Eigen::SparseLU<SparseMatrix>>(); }
#endif

}  // namespace scarp

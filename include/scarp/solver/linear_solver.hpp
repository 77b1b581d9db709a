// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <algorithm>
#include <concepts>
#include <vector>

#include "scarp/core/status.hpp"

namespace scarp {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// factorize(matrix): failed / singular_system or not_finite where it cannot; solve(right), after an acceptable one;
/// solve_transposed(right): with the transposed matrix.
template <class Solver>
concept LinearSolver = std::default_initializable<Solver> &&
    requires(Solver& solver, Solver const& constant, SparseMatrix const& matrix, Eigen::VectorXd const& right) {
  { solver.factorize(matrix) } -> std::same_as<Verdict>;
  { constant.solve(right) } -> std::same_as<Eigen::VectorXd>;
  { constant.solve_transposed(right) } -> std::same_as<Eigen::VectorXd>;
};

namespace detail {
/// What is missing, in words.
template <class Solver>
struct MissingOfLinearSolver {
  static_assert(std::default_initializable<Solver>, "scarp: a linear solver is made without arguments");
  static_assert(
      requires(Solver & solver, SparseMatrix const& matrix) {
        { solver.factorize(matrix) } -> std::same_as<Verdict>;
      },
      "scarp: a linear solver needs `Verdict factorize(SparseMatrix const&)`");
  static_assert(
      requires(Solver const& solver, Eigen::VectorXd const& right) {
        { solver.solve(right) } -> std::same_as<Eigen::VectorXd>;
      },
      "scarp: a linear solver needs `Eigen::VectorXd solve(Eigen::VectorXd const&) const`");
  static_assert(
      requires(Solver const& solver, Eigen::VectorXd const& right) {
        { solver.solve_transposed(right) } -> std::same_as<Eigen::VectorXd>;
      },
      "scarp: a linear solver needs `Eigen::VectorXd solve_transposed(Eigen::VectorXd const&) const`");
  static constexpr bool nothing = false;
};
}  // namespace detail

/// The same; of a type that is none the compiler says in words what is missing.
template <class Solver>
concept CheckedLinearSolver = LinearSolver<Solver> || detail::MissingOfLinearSolver<Solver>::nothing;

namespace detail {

/// What all direct solvers of Eigen's kind have in common: the ordering is kept as long as the matrix keeps its pattern.
class PatternMemory {
 public:
  /// Whether the matrix has another pattern than the last one, which it replaces.
  bool changes_to(SparseMatrix const& matrix) {
    bool const same = matrix.rows() == rows_ && matrix.nonZeros() == static_cast<Eigen::Index>(inner_.size()) &&
                      std::equal(inner_.begin(), inner_.end(), matrix.innerIndexPtr()) &&
                      std::equal(outer_.begin(), outer_.end(), matrix.outerIndexPtr());
    if (same) return false;
    rows_ = matrix.rows();
    inner_.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
    outer_.assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize());
    return true;
  }

 private:
  Eigen::Index rows_ = -1;
  std::vector<int> inner_;
  std::vector<int> outer_;
};

/// A direct solver of Eigen's interface with named failures.
template <class Factorisation>
Verdict factorize_with(Factorisation& solver, PatternMemory& pattern, SparseMatrix const& matrix) {
  if (!matrix.coeffs().allFinite()) return {Status::failed, Reason::not_finite};
  if (pattern.changes_to(matrix)) solver.analyzePattern(matrix);
  solver.factorize(matrix);
  if (solver.info() != Eigen::Success) return {Status::failed, Reason::singular_system};
  return {};
}

}  // namespace detail
}  // namespace scarp

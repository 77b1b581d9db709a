// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <vector>

#include "scarp/core/status.hpp"

namespace scarp {

using SparseMatrix = Eigen::SparseMatrix<double>;  ///< Compressed by columns, of double precision.

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

/// What all direct solvers of Eigen's kind have in common: the ordering is reused as long as the matrix has the same pattern.
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

/// Estimate of the condition number in the 1-norm, |A| |A^-1|, from a few solves: a lower bound, seldom below a third of the
/// truth (Hager, SIAM J. Sci. Stat. Comput. 5, 1984; Higham, ACM TOMS 14, 1988). Infinite when a solve is not finite.
template <LinearSolver Solver>
double condition_estimate(SparseMatrix const& matrix, Solver const& solver) {
  Eigen::Index const size = matrix.rows();
  if (size == 0) return 1.0;
  Eigen::VectorXd x = Eigen::VectorXd::Constant(size, 1.0 / static_cast<double>(size));
  double inverse_norm = 0.0;
  constexpr int most = 5;
  for (int k = 0; k < most; ++k) {
    Eigen::VectorXd const y = solver.solve(x);
    if (!y.allFinite()) return std::numeric_limits<double>::infinity();
    double const found = y.lpNorm<1>();
    if (found <= inverse_norm) break;
    inverse_norm = found;
    Eigen::VectorXd const signs = y.unaryExpr([](double value) { return value < 0.0 ? -1.0 : 1.0; });
    Eigen::VectorXd const z = solver.solve_transposed(signs);
    if (!z.allFinite()) return std::numeric_limits<double>::infinity();
    Eigen::Index steepest = 0;
    if (z.cwiseAbs().maxCoeff(&steepest) <= z.dot(x)) break;
    x = Eigen::VectorXd::Unit(size, steepest);
  }
  double norm = 0.0;
  for (Eigen::Index column = 0; column < size; ++column) {
    double sum = 0.0;
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) sum += std::abs(entry.value());
    norm = std::max(norm, sum);
  }
  return norm * inverse_norm;
}

/// The unknown that a singular or nearly singular matrix holds least: largest entry of the vector that it maps nearest
/// to nothing, by inverse iteration with a small shift; any unknown where the whole matrix is zero. -1 when that fails.
template <LinearSolver Solver>
int weakest_unknown(SparseMatrix const& matrix) {
  Eigen::Index const size = matrix.rows();
  if (size == 0 || !matrix.coeffs().allFinite()) return -1;
  double const largest = matrix.nonZeros() > 0 ? matrix.coeffs().abs().maxCoeff() : 0.0;
  double const shift = largest > 0.0 ? 1e-9 * largest : 1.0;
  SparseMatrix unit(size, size);
  unit.setIdentity();
  Solver solver;
  if (!solver.factorize(matrix + shift * unit).acceptable()) return -1;
  Eigen::VectorXd mode(size);
  for (Eigen::Index k = 0; k < size; ++k) mode(k) = 1.0 + 0.3 * std::sin(1.7 * static_cast<double>(k));
  for (int k = 0; k < 3; ++k) {
    mode = solver.solve(mode / mode.norm());
    if (!mode.allFinite()) return -1;
  }
  Eigen::Index weakest = 0;
  mode.cwiseAbs().maxCoeff(&weakest);
  return static_cast<int>(weakest);
}

}  // namespace scarp

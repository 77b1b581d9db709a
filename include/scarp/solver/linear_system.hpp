// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "scarp/bvp/constraints.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/interruption.hpp"
#include "scarp/core/linear_map.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/solver/linear_solver.hpp"

namespace scarp {

/// Stiffness [N/m] of a ground, shape (degrees of freedom, twice). Where the stress of a point changes with its own
/// strain and with the mean strain around it,
/// \f$ K = K(\sigma, C^{own}) + \sum_i v_i B_i^T (C_i + C^{mean}_i) \sum_j w_{ij} B_j \f$: the second part couples all
/// points within the length and is not symmetric; it is applied, never assembled.
struct SCARP_EXPORT GroundStiffness {
  SparseMatrix own;  ///< what the elements hold without their neighbours
  /// Forces of the second part, of the mesh's degrees of freedom, the first ones; shared by copies, none for local
  /// ground.
  std::shared_ptr<LinearMap const> around{};
  LinearIteration iterate = nullptr;  ///< solves with the second part

  /// Forces [N] against a small further displacement [m]; shape (degrees of freedom)
  Eigen::VectorXd operator*(Eigen::VectorXd const& displacement) const;
};

/// Equations of the free degrees of freedom: their numbering, stiffness and factors. They are solved directly; with a
/// part that is not assembled by an iteration with the factors of the other one: that handles waves shorter than the
/// length, of which there are many; means see the few that are longer.
class SCARP_EXPORT LinearSystem {
 public:
  /// It has no equations before the first factorize().
  /// \throws InputError for a factory that makes no solver
  explicit LinearSystem(Constraints const& constraints, LinearSolverFactory solver = sparse_lu);

  /// Number of equations.
  Eigen::Index free_count() const { return static_cast<Eigen::Index>(free_dofs_.size()); }
  /// \throws InputError for another number of free degrees of freedom, that of a saved state
  void require_free(std::size_t saved) const;
  /// Entries of the free degrees of freedom, shape (free_count).
  Eigen::VectorXd gather(Eigen::VectorXd const& full) const;
  /// Writes the free entries into a full vector and leaves the prescribed ones.
  void scatter(Eigen::VectorXd const& part, Eigen::VectorXd& full) const;

  /// Takes the rows and columns of the free degrees of freedom of a stiffness on all of them.
  /// \return singular_system or not_finite where there are no factors
  Verdict factorize(GroundStiffness const& stiffness);
  /// Rows and columns [N/m] that have factors, shape (free_count, free_count).
  SparseMatrix const& matrix() const { return matrix_; }

  /// Displacement [m] that needs a force [N], both of shape (free_count), as far as an iteration comes.
  Eigen::VectorXd solve(Eigen::VectorXd const& force) const;
  /// Force [N] of a displacement [m], both of shape (free_count).
  Eigen::VectorXd product(Eigen::VectorXd const& displacement) const;

  /// Moves an increment [m], kept at its prescribed entries, by what removes unbalanced forces [N], both on all degrees
  /// of freedom. It stays where there is no solution.
  Verdict correct(Eigen::VectorXd& increment, Eigen::VectorXd const& unbalanced);
  /// |K x - b| / |b| of the last correction.
  double residual() const { return residual_; }

  /// Estimate of the condition number of the matrix in the 1-norm, |A| |A^-1|, from a few solves: a lower bound, seldom
  /// below a third of the truth (Hager, SIAM J. Sci. Stat. Comput. 5, 1984; Higham, ACM TOMS 14, 1988). Infinite when a
  /// solve is not finite.
  double condition() const;

  /// The degree of freedom that a singular or nearly singular matrix holds least: largest entry of the vector that it
  /// maps nearest to nothing, by inverse iteration with a small shift; any one where the whole matrix is zero. -1 when
  /// that fails.
  int weakest_dof() const;

 private:
  SparseMatrix reduced(SparseMatrix const& full) const;

  std::vector<int> free_dofs_;   ///< in increasing order
  std::vector<int> free_index_;  ///< of each degree of freedom, -1 for a prescribed one
  LinearSolverFactory make_solver_;
  std::unique_ptr<LinearSolver> solver_;
  SparseMatrix matrix_;
  std::shared_ptr<LinearMap const> around_;  ///< see GroundStiffness
  LinearIteration iterate_ = nullptr;
  double residual_ = 0.0;
};

#ifdef SCARP_DEFINITIONS
SCARP_DEFINITIONS Eigen::VectorXd GroundStiffness::operator*(Eigen::VectorXd const& displacement) const {
  Eigen::VectorXd forces = own * displacement;
  if (!around) return forces;
  Eigen::VectorXd const more = (*around)(displacement);
  forces.head(more.size()) += more;
  return forces;
}

SCARP_DEFINITIONS LinearSystem::LinearSystem(Constraints const& constraints, LinearSolverFactory solver)
    : free_dofs_(constraints.free_dofs()),
      free_index_(detail::index(constraints.dof_count()), -1),
      make_solver_(std::move(solver)),
      solver_(make_solver_()) {
  if (!solver_) reject("the factory of linear solvers makes none: let it return one, such as sparse_lu()");
  for (std::size_t k = 0; k < free_dofs_.size(); ++k) free_index_[detail::index(free_dofs_[k])] = static_cast<int>(k);
}

SCARP_DEFINITIONS void LinearSystem::require_free(std::size_t saved) const {
  if (saved != free_dofs_.size())
    reject("the saved state has {} free degrees of freedom (the problem has {}): resume it with the same constraints",
           saved, free_dofs_.size());
}

SCARP_DEFINITIONS Eigen::VectorXd LinearSystem::gather(Eigen::VectorXd const& full) const {
  Eigen::VectorXd part(free_count());
  for (Eigen::Index k = 0; k < part.size(); ++k) part(k) = full(free_dofs_[detail::index(k)]);
  return part;
}

SCARP_DEFINITIONS void LinearSystem::scatter(Eigen::VectorXd const& part, Eigen::VectorXd& full) const {
  for (Eigen::Index k = 0; k < part.size(); ++k) full(free_dofs_[detail::index(k)]) = part(k);
}

SCARP_DEFINITIONS Verdict LinearSystem::factorize(GroundStiffness const& stiffness) {
  InterruptionCheck::run();
  matrix_ = reduced(stiffness.own);
  around_ = stiffness.around;
  iterate_ = stiffness.iterate;
  // Without free degrees of freedom, as in a test of a law on one element, there are no equations.
  return free_count() == 0 ? Verdict{} : solver_->factorize(matrix_);
}

SCARP_DEFINITIONS Eigen::VectorXd LinearSystem::solve(Eigen::VectorXd const& force) const {
  if (!around_) return solver_->solve(force);
  auto const solved = [this](Eigen::VectorXd const& right) {
    InterruptionCheck::run();
    return solver_->solve(right);
  };
  return iterate_([this](Eigen::VectorXd const& x) { return product(x); }, solved, force);
}

SCARP_DEFINITIONS Eigen::VectorXd LinearSystem::product(Eigen::VectorXd const& displacement) const {
  Eigen::VectorXd forces = matrix_ * displacement;
  if (!around_) return forces;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(detail::count(free_index_));
  scatter(displacement, all);
  Eigen::VectorXd const more = (*around_)(all);
  all.setZero();
  all.head(more.size()) = more;
  return forces + gather(all);
}

SCARP_DEFINITIONS Verdict LinearSystem::correct(Eigen::VectorXd& increment, Eigen::VectorXd const& unbalanced) {
  if (free_count() == 0) return {};
  Eigen::VectorXd const force = -gather(unbalanced);
  Eigen::VectorXd const correction = solve(force);
  double const norm = force.norm();
  residual_ = norm > 0.0 ? (product(correction) - force).norm() / norm : 0.0;
  if (!(residual_ < 1.0)) return {Status::failed, Reason::singular_system};
  constexpr double stagnated = 0.1;  // an iteration that ends with more found no solution
  if (around_ && residual_ > stagnated) return {Status::not_converged, Reason::iterations_spent};
  scatter(gather(increment) + correction, increment);
  return {};
}

SCARP_DEFINITIONS double LinearSystem::condition() const {
  Eigen::Index const size = matrix_.rows();
  if (size == 0) return 1.0;
  Eigen::VectorXd x = Eigen::VectorXd::Constant(size, 1.0 / static_cast<double>(size));
  double inverse_norm = 0.0;
  constexpr int most = 5;
  for (int k = 0; k < most; ++k) {
    Eigen::VectorXd const y = solver_->solve(x);
    if (!y.allFinite()) return std::numeric_limits<double>::infinity();
    double const found = y.lpNorm<1>();
    if (found <= inverse_norm) break;
    inverse_norm = found;
    Eigen::VectorXd const signs = y.unaryExpr([](double value) { return value < 0.0 ? -1.0 : 1.0; });
    Eigen::VectorXd const z = solver_->solve_transposed(signs);
    if (!z.allFinite()) return std::numeric_limits<double>::infinity();
    Eigen::Index steepest = 0;
    if (z.cwiseAbs().maxCoeff(&steepest) <= z.dot(x)) break;
    x = Eigen::VectorXd::Unit(size, steepest);
  }
  double norm = 0.0;
  for (Eigen::Index column = 0; column < size; ++column) {
    double sum = 0.0;
    for (SparseMatrix::InnerIterator entry(matrix_, column); entry; ++entry) sum += std::abs(entry.value());
    norm = std::max(norm, sum);
  }
  return norm * inverse_norm;
}

SCARP_DEFINITIONS int LinearSystem::weakest_dof() const {
  InterruptionCheck::run();
  Eigen::Index const size = matrix_.rows();
  if (size == 0 || !matrix_.coeffs().allFinite()) return -1;
  double const largest = matrix_.nonZeros() > 0 ? matrix_.coeffs().abs().maxCoeff() : 0.0;
  double const shift = largest > 0.0 ? 1e-9 * largest : 1.0;
  SparseMatrix unit(size, size);
  unit.setIdentity();
  SparseMatrix const shifted = matrix_ + shift * unit;
  auto const solver = make_solver_();
  if (!solver->factorize(shifted).acceptable()) return -1;
  Eigen::VectorXd mode(size);
  for (Eigen::Index k = 0; k < size; ++k) mode(k) = 1.0 + 0.3 * std::sin(1.7 * static_cast<double>(k));
  for (int k = 0; k < 3; ++k) {
    mode = solver->solve(mode / mode.norm());
    if (!mode.allFinite()) return -1;
  }
  Eigen::Index weakest = 0;
  mode.cwiseAbs().maxCoeff(&weakest);
  return free_dofs_[detail::index(weakest)];
}

SCARP_DEFINITIONS SparseMatrix LinearSystem::reduced(SparseMatrix const& full) const {
  Eigen::Index const size = free_count();
  SparseMatrix part(size, size);
  part.reserve(full.nonZeros());
  for (Eigen::Index column = 0; column < size; ++column) {
    part.startVec(column);
    for (SparseMatrix::InnerIterator entry(full, free_dofs_[detail::index(column)]); entry; ++entry) {
      int const row = free_index_[detail::index(entry.row())];
      if (row >= 0) part.insertBack(row, column) = entry.value();
    }
  }
  part.finalize();
  return part;
}
#endif

}  // namespace scarp

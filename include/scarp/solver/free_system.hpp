// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

#include "scarp/bvp/constraints.hpp"
#include "scarp/core/index.hpp"
#include "scarp/solver/ground_stiffness.hpp"
#include "scarp/solver/linear_solver.hpp"

namespace scarp {

/// Part of a stiffness matrix that belongs to the free degrees of freedom, and the coupling to prescribed displacements.
class FreeSystem {
 public:
  /// Of the degrees of freedom that the constraints leave free.
  explicit FreeSystem(Constraints const& constraints) : FreeSystem(constraints.free_dofs(), constraints.dof_count()) {}

  /// free_dofs: in increasing order, of `dof_count` in all
  FreeSystem(std::vector<int> free_dofs, int dof_count)
      : free_dofs_(std::move(free_dofs)), free_index_(detail::index(dof_count), -1) {
    for (std::size_t k = 0; k < free_dofs_.size(); ++k) free_index_[detail::index(free_dofs_[k])] = static_cast<int>(k);
  }

  /// Degrees of freedom, free and prescribed.
  Eigen::Index dof_count() const { return static_cast<Eigen::Index>(free_index_.size()); }
  /// Order of the reduced system.
  Eigen::Index free_count() const { return static_cast<Eigen::Index>(free_dofs_.size()); }

  /// Rows and columns [N/m] of the free degrees of freedom, shape (free_count, free_count).
  Eigen::SparseMatrix<double> matrix(Eigen::SparseMatrix<double> const& full) const {
    Eigen::Index const size = free_count();
    Eigen::SparseMatrix<double> part(size, size);
    part.reserve(full.nonZeros());
    for (Eigen::Index column = 0; column < size; ++column) {
      part.startVec(column);
      for (Eigen::SparseMatrix<double>::InnerIterator entry(full, free_dofs_[detail::index(column)]); entry; ++entry) {
        int const row = free_index_[detail::index(entry.row())];
        if (row >= 0) part.insertBack(row, column) = entry.value();
      }
    }
    part.finalize();
    return part;
  }

  /// Number among all degrees of freedom of a free one; -1 stays.
  int dof(int free) const { return free < 0 ? -1 : free_dofs_[detail::index(free)]; }

  /// Entries of the free degrees of freedom, shape (free_count).
  Eigen::VectorXd gather(Eigen::VectorXd const& full) const {
    Eigen::VectorXd part(free_count());
    for (std::size_t k = 0; k < free_dofs_.size(); ++k) part(static_cast<Eigen::Index>(k)) = full(free_dofs_[k]);
    return part;
  }

  /// Writes the free entries into a full vector and leaves the prescribed ones.
  void scatter(Eigen::VectorXd const& part, Eigen::VectorXd& full) const {
    for (std::size_t k = 0; k < free_dofs_.size(); ++k) full(free_dofs_[k]) = part(static_cast<Eigen::Index>(k));
  }

 private:
  std::vector<int> free_dofs_;
  std::vector<int> free_index_;
};

}  // namespace scarp

namespace scarp::detail {

/// Equations of the free degrees of freedom for a ground's stiffness, solved directly; where it is not assembled as a whole by
/// an iteration with the factors of what the elements hold alone: that part handles waves shorter than the length, of which there are
/// many; means see the few that are longer.
template <LinearSolver Linear>
class GroundEquations {
 public:
  /// The system must outlive the equations.
  Verdict factorize(FreeSystem const& system, GroundStiffness const& stiffness) {
    system_ = &system;
    matrix_ = system.matrix(stiffness.own);
    around_ = stiffness.around;
    iterate_ = stiffness.iterate;
    return linear_.factorize(matrix_);
  }
  /// As far as an iteration comes; the residual shows how far.
  Eigen::VectorXd solve(Eigen::VectorXd const& force) const {
    if (!around_) return linear_.solve(force);
    return iterate_([this](Eigen::VectorXd const& x) { return product(x); },
                    [this](Eigen::VectorXd const& right) { return linear_.solve(right); }, force);
  }
  Eigen::VectorXd product(Eigen::VectorXd const& displacement) const {
    Eigen::VectorXd forces = matrix_ * displacement;
    if (!around_) return forces;
    Eigen::VectorXd all = Eigen::VectorXd::Zero(system_->dof_count());
    system_->scatter(displacement, all);
    Eigen::VectorXd const more = (*around_)(all);
    all.setZero();
    all.head(more.size()) = more;
    return forces + system_->gather(all);
  }
  /// Of what the elements hold alone.
  double condition() const { return condition_estimate(matrix_, linear_); }
  int weakest() const { return weakest_unknown<Linear>(matrix_); }

 private:
  Linear linear_;
  SparseMatrix matrix_;
  FreeSystem const* system_ = nullptr;
  std::shared_ptr<LinearMap const> around_;  ///< see GroundStiffness
  LinearIteration iterate_ = nullptr;
};

}  // namespace scarp::detail

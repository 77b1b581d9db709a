// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scarp/bvp/constraints.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// Part of a stiffness matrix that belongs to the free degrees of freedom, and the coupling to prescribed displacements.
class FreeSystem {
 public:
  explicit FreeSystem(Constraints const& constraints) : free_dofs_(constraints.free_dofs()) {
    free_index_.assign(detail::index(constraints.dof_count()), -1);
    for (std::size_t k = 0; k < free_dofs_.size(); ++k) free_index_[detail::index(free_dofs_[k])] = static_cast<int>(k);
  }

  Eigen::Index free_count() const { return static_cast<Eigen::Index>(free_dofs_.size()); }

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

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseLU>

#include "scarp/solver/linear_solver.hpp"

namespace scarp {

/// Direct solver for unsymmetric sparse systems (Eigen's supernodal LU with column ordering).
/// It takes longest to compile of all that a scene needs. A program of many sources can define SCARP_SPARSE_LU_ELSEWHERE for
/// them and include sparse_lu_definitions.hpp in one.
class SparseLu {
 public:
  Verdict factorize(SparseMatrix const& matrix);
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const;
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const;

 private:
  // Eigen's solver hands out its transposed view from a non-const object only.
  mutable Eigen::SparseLU<SparseMatrix> solver_;
  detail::PatternMemory pattern_;
};

static_assert(LinearSolver<SparseLu>);

}  // namespace scarp

#ifndef SCARP_SPARSE_LU_ELSEWHERE
#include "scarp/solver/sparse_lu_definitions.hpp"
#endif

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseLU>

#include "scarp/core/precompiled.hpp"
#include "scarp/solver/linear_solver.hpp"

namespace scarp {

/// Direct solver for unsymmetric sparse systems (Eigen's supernodal LU with column ordering).
class SCARP_EXPORT SparseLu {
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

#ifndef SCARP_PRECOMPILED
#include "scarp/solver/sparse_lu_definitions.hpp"
#endif

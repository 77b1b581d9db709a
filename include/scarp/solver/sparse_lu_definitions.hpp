// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/solver/sparse_lu.hpp"

#ifdef SCARP_PRECOMPILED
#define SCARP_SPARSE_LU_INLINE
#else
#define SCARP_SPARSE_LU_INLINE inline
#endif

namespace scarp {

SCARP_SPARSE_LU_INLINE Verdict SparseLu::factorize(SparseMatrix const& matrix) {
  return detail::factorize_with(solver_, pattern_, matrix);
}

SCARP_SPARSE_LU_INLINE Eigen::VectorXd SparseLu::solve(Eigen::VectorXd const& right) const {
  return solver_.solve(right);
}

SCARP_SPARSE_LU_INLINE Eigen::VectorXd SparseLu::solve_transposed(Eigen::VectorXd const& right) const {
  return solver_.transpose().solve(right);
}

}  // namespace scarp

#undef SCARP_SPARSE_LU_INLINE

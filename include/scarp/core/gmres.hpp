// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/linear_map.hpp"
#include "scarp/core/precompiled.hpp"
#if !defined(SCARP_PRECOMPILED) || defined(SCARP_GMRES_DEFINITIONS)
#include <Eigen/SparseCore>
#include <unsupported/Eigen/IterativeSolvers>
#endif

namespace scarp {

/// Restarted GMRES (Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856), a LinearIteration.
SCARP_EXPORT Eigen::VectorXd gmres(LinearMap const& matrix, LinearMap const& preconditioner,
                                   Eigen::VectorXd const& right);

}  // namespace scarp

#ifndef SCARP_PRECOMPILED
/// Keyword of gmres() where the header defines it; undefined where the precompiled library does.
#define SCARP_GMRES_DEFINITIONS inline
#endif
#ifdef SCARP_GMRES_DEFINITIONS  // empty in the library that contains them
namespace scarp::detail {
class AppliedMatrix;
}  // namespace scarp::detail

namespace Eigen::internal {

template <>
struct traits<scarp::detail::AppliedMatrix> : traits<Eigen::SparseMatrix<double>> {};

}  // namespace Eigen::internal

namespace scarp::detail {

/// A linear map as Eigen's iterative solvers want a matrix.
class AppliedMatrix : public Eigen::EigenBase<AppliedMatrix> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  using Index = Eigen::EigenBase<AppliedMatrix>::Index;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  AppliedMatrix(LinearMap const& map, Index size) : map_(map), size_(size) {}

  Index rows() const { return size_; }
  Index cols() const { return size_; }
  Eigen::VectorXd product(Eigen::VectorXd const& right) const { return map_(right); }
  template <class Right>
  Eigen::Product<AppliedMatrix, Right, Eigen::AliasFreeProduct> operator*(Eigen::MatrixBase<Right> const& right) const {
    return {*this, right.derived()};
  }

 private:
  LinearMap const& map_;
  Index size_;
};

/// A linear map as a preconditioner.
struct AppliedPreconditioner {
  LinearMap const* map = nullptr;

  template <class Matrix>
  AppliedPreconditioner& compute(Matrix const&) {
    return *this;
  }
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const { return (*map)(right); }
  static Eigen::ComputationInfo info() { return Eigen::Success; }
};

}  // namespace scarp::detail

namespace Eigen::internal {

template <class Right>
struct generic_product_impl<scarp::detail::AppliedMatrix, Right, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<scarp::detail::AppliedMatrix, Right,
                                generic_product_impl<scarp::detail::AppliedMatrix, Right>> {
  template <class Result>
  static void scaleAndAddTo(Result& result, scarp::detail::AppliedMatrix const& matrix, Right const& right,
                            double factor) {
    result += factor * matrix.product(right);
  }
};

}  // namespace Eigen::internal

namespace scarp {

SCARP_GMRES_DEFINITIONS Eigen::VectorXd gmres(LinearMap const& matrix, LinearMap const& preconditioner,
                                              Eigen::VectorXd const& right) {
  // Iterations of a load step are as many with 1e-3 as with 1e-8.
  constexpr double accuracy = 1e-4;  // of the preconditioned residual
  constexpr int directions = 60;
  constexpr int max_products = 300;
  detail::AppliedMatrix const applied(matrix, right.size());
  Eigen::GMRES<detail::AppliedMatrix, detail::AppliedPreconditioner> iteration;
  iteration.preconditioner().map = &preconditioner;
  iteration.setTolerance(accuracy).set_restart(directions);
  iteration.setMaxIterations(max_products).compute(applied);
  return iteration.solve(right);
}

}  // namespace scarp
#endif
#undef SCARP_GMRES_DEFINITIONS

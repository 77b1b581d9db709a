// SPDX-License-Identifier: BSL-1.0
/// \file
/// What a problem whose points see means of their neighbours needs beside others: to be included before its solver.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <memory>
#include <unsupported/Eigen/IterativeSolvers>
#include <utility>
#include <vector>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/material_field.hpp"
#include "scarp/core/index.hpp"
#include "scarp/solver/free_system.hpp"
#ifdef SCARP_PRECOMPILED
#include "scarp/solver/quasi_newton.hpp"
#endif

namespace scarp {

/// Stiffness [N/m] at the end of an increment where the stress of a point changes with its own strain and with the mean
/// strain around it, \f$ K = K(\sigma, C^{own}) + \sum_i v_i B_i^T (C_i + C^{mean}_i) \sum_j w_{ij} B_j \f$. It couples all
/// points within the length and is not symmetric: it is applied, never assembled.
template <int Dim>
class WideStiffness {
 public:
  using Strains = std::vector<EngineeringStrain<Dim>>;
  /// Means of the strains of all points around each of them.
  using Means = std::function<Strains(Strains const&)>;

  WideStiffness() = default;

  /// means: see Means, empty where every mean is the value itself
  template <class DiscretisationType>
  WideStiffness(DiscretisationType const& discretisation, Eigen::VectorXd const& increment,
                std::vector<VoigtStress<Dim>> const& stresses, SplitTangents<Dim> const& tangents, Means means) {
    discretisation.stiffness(increment, stresses, tangents.by_own, own_);
    if (!means) return;
    auto around = std::make_shared<Around>();
    around->strains = discretisation.strain_operator(increment);
    around->means = std::move(means);
    auto const volumes = discretisation.volumes(increment);
    for (std::size_t k = 0; k < volumes.size(); ++k) around->answers.push_back(volumes[k] * tangents.by_mean[k]);
    around_ = std::move(around);
  }

  /// What the elements hold without their neighbours; all of it where there are none.
  Eigen::SparseMatrix<double> const& own() const { return own_; }
  bool is_local() const { return around_ == nullptr; }

  /// The same for more degrees of freedom, behind those of the mesh, which nothing here holds.
  void conservativeResize(Eigen::Index rows, Eigen::Index columns) { own_.conservativeResize(rows, columns); }

  /// more: [N/m], shape (degrees of freedom, twice)
  friend WideStiffness operator+(WideStiffness stiffness, Eigen::SparseMatrix<double> const& more) {
    stiffness.own_ += more;
    return stiffness;
  }

  /// Forces [N] against a small further displacement [m]; shape (degrees of freedom)
  Eigen::VectorXd operator*(Eigen::VectorXd const& displacement) const {
    Eigen::VectorXd forces = own_ * displacement;
    if (is_local()) return forces;
    Eigen::Index const of_mesh = around_->strains.cols();
    Eigen::VectorXd values = around_->strains * displacement.head(of_mesh);
    Strains strains(around_->answers.size());
    for (std::size_t k = 0; k < strains.size(); ++k) strains[k] = of_point(values, k);
    strains = around_->means(strains);
    for (std::size_t k = 0; k < strains.size(); ++k) of_point(values, k) = around_->answers[k] * strains[k];
    forces.head(of_mesh) += around_->strains.transpose() * values;
    return forces;
  }

 private:
  struct Around {
    Eigen::SparseMatrix<double> strains;     ///< of all points from displacements
    std::vector<VoigtTangent<Dim>> answers;  ///< stresses times volume [N m] from means
    Means means;
  };

  static auto of_point(Eigen::VectorXd& values, std::size_t k) {
    constexpr int size = voigt_size<Dim>;
    return values.segment<size>(static_cast<Eigen::Index>(size * k));
  }

  Eigen::SparseMatrix<double> own_;
  std::shared_ptr<Around const> around_;
};

}  // namespace scarp

namespace scarp::detail {
/// Free part of a wide stiffness, as Eigen's iterative solvers want a matrix.
template <int Dim>
class WideMatrix;
}  // namespace scarp::detail

namespace Eigen::internal {

template <int Dim>
struct traits<scarp::detail::WideMatrix<Dim>> : traits<SparseMatrix<double>> {};

template <int Dim, class Right>
struct generic_product_impl<scarp::detail::WideMatrix<Dim>, Right, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<scarp::detail::WideMatrix<Dim>, Right,
                                generic_product_impl<scarp::detail::WideMatrix<Dim>, Right>> {
  template <class Result>
  static void scaleAndAddTo(Result& result, scarp::detail::WideMatrix<Dim> const& matrix, Right const& right,
                            double factor) {
    result += factor * matrix.product(right);
  }
};

}  // namespace Eigen::internal

namespace scarp::detail {

template <int Dim>
class WideMatrix : public Eigen::EigenBase<WideMatrix<Dim>> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  using Index = typename Eigen::EigenBase<WideMatrix>::Index;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  WideMatrix() = default;
  WideMatrix(FreeSystem const& system, WideStiffness<Dim> stiffness)
      : system_(&system), stiffness_(std::move(stiffness)) {}

  Index rows() const { return system_->free_count(); }
  Index cols() const { return rows(); }
  template <class Right>
  Eigen::Product<WideMatrix, Right, Eigen::AliasFreeProduct> operator*(Eigen::MatrixBase<Right> const& right) const {
    return {*this, right.derived()};
  }

  Eigen::VectorXd product(Eigen::VectorXd const& displacement) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(stiffness_.own().cols());
    system_->scatter(displacement, all);
    return system_->gather(stiffness_ * all);
  }

 private:
  FreeSystem const* system_ = nullptr;
  WideStiffness<Dim> stiffness_;
};

/// A factorised matrix as a preconditioner of Eigen's.
template <class Linear>
struct Factors {
  Linear const* linear = nullptr;

  template <class Matrix>
  Factors& compute(Matrix const&) {
    return *this;
  }
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const { return linear->solve(right); }
  static Eigen::ComputationInfo info() { return Eigen::Success; }
};

/// GMRES with the factors of what the elements hold alone as preconditioner: that part answers waves shorter than the length, of
/// which there are many; means see the few that are longer.
template <int Dim, LinearSolver Linear>
class GroundEquations<WideStiffness<Dim>, Linear> {
 public:
  Verdict factorize(FreeSystem const& system, WideStiffness<Dim> const& stiffness) {
    local_ = stiffness.is_local();
    own_ = system.matrix(stiffness.own());
    if (!local_) wide_ = WideMatrix<Dim>(system, stiffness);
    return linear_.factorize(own_);
  }

  /// As far as the iteration comes; the residual tells.
  Eigen::VectorXd solve(Eigen::VectorXd const& force) {
    if (local_) return linear_.solve(force);
    Eigen::GMRES<WideMatrix<Dim>, Factors<Linear>> iteration;
    iteration.preconditioner().linear = &linear_;
    iteration.setTolerance(accuracy).set_restart(directions);
    iteration.setMaxIterations(most_products).compute(wide_);
    return iteration.solve(force);
  }
  Eigen::VectorXd product(Eigen::VectorXd const& displacement) const {
    return local_ ? Eigen::VectorXd(own_ * displacement) : wide_.product(displacement);
  }
  /// Of what the elements hold alone.
  double condition() const { return condition_estimate(own_, linear_); }
  int weakest() const { return weakest_unknown<Linear>(own_); }

 private:
  // Iterations of the load step are as many with 1e-3 as with 1e-8.
  static constexpr double accuracy = 1e-4;  ///< of the preconditioned residual
  static constexpr int directions = 60;
  static constexpr int most_products = 300;

  bool local_ = true;
  Linear linear_;
  SparseMatrix own_;
  WideMatrix<Dim> wide_;
};

template <AveragesGradients Materials>
struct GroundStiffness<Materials> {
  using Type = WideStiffness<Materials::dim>;
};

}  // namespace scarp::detail

#ifdef SCARP_PRECOMPILED
/// DECLARE: `extern template`, or `template` in the library.
#define SCARP_WIDE_SESSIONS(DECLARE)                                                                         \
  DECLARE class QuasiNewtonSession<QuasiNewton<>, IncrementalProblem<2, WideStiffness<2>>>;                  \
  DECLARE class QuasiNewtonSession<QuasiNewton<>, AttachedProblem<2, WideStiffness<2>>>;                     \
  DECLARE class QuasiNewtonSession<QuasiNewton<ConsistentTangent>, IncrementalProblem<2, WideStiffness<2>>>; \
  DECLARE class QuasiNewtonSession<QuasiNewton<ConsistentTangent>, AttachedProblem<2, WideStiffness<2>>>;

namespace scarp {
SCARP_WIDE_SESSIONS(extern template)
}  // namespace scarp
#endif

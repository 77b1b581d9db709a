// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include "scarp/constitutive/material_field.hpp"
#include "scarp/solver/free_system.hpp"
#include "scarp/solver/linear_solver.hpp"

namespace scarp::detail {

/// The type of a ground's stiffness.
template <class Materials>
struct GroundStiffness {
  static_assert(!AveragesGradients<Materials>,
                "scarp: points that see means need `#include \"scarp/solver/wide_equations.hpp\"`, which "
                "scene/nonlocal_scene.hpp does");
  using Type = Eigen::SparseMatrix<double>;
};

/// Equations of the free degrees of freedom for a stiffness of one type, here a sparse matrix that is solved directly.
template <class Stiffness, LinearSolver Linear>
class GroundEquations {
 public:
  Verdict factorize(FreeSystem const& system, Stiffness const& stiffness) {
    matrix_ = system.matrix(stiffness);
    return linear_.factorize(matrix_);
  }
  Eigen::VectorXd solve(Eigen::VectorXd const& force) { return linear_.solve(force); }
  Eigen::VectorXd product(Eigen::VectorXd const& displacement) const { return matrix_ * displacement; }
  double condition() const { return condition_estimate(matrix_, linear_); }
  int weakest() const { return weakest_unknown<Linear>(matrix_); }

 private:
  Linear linear_;
  SparseMatrix matrix_;
};

}  // namespace scarp::detail

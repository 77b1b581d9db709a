// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/solver/ground_stiffness.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

/// What a solver needs of a boundary-value problem in increments, whatever its elements, materials, loads and executor are: a
/// solver is compiled once for each dimension. `EquilibriumProblem` documents each member.
template <int Dim>
class IncrementalProblem {
 public:
  static constexpr int dim = Dim;
  static constexpr bool is_bare = true;

  virtual ~IncrementalProblem() = default;

  virtual int dof_count() const = 0;
  virtual Constraints const& constraints() const = 0;
  virtual LoadHistory const& loads() const = 0;
  virtual std::vector<Gradient<Dim>> const& gradients() const = 0;
  virtual std::vector<Response<Dim>> const& responses() const = 0;
  virtual std::vector<VoigtStress<Dim>> committed_stresses() const = 0;
  virtual std::vector<VoigtTangent<Dim>> committed_tangents() const = 0;
  virtual std::vector<VoigtTangent<Dim>> trial_tangents() const = 0;
  virtual double max_displacement_gradient() const = 0;
  virtual bool turns_stresses() const = 0;

  virtual void set_load(double load) = 0;
  virtual Verdict plan(Eigen::VectorXd const& increment, int* worst_point = nullptr) = 0;
  virtual Evaluation evaluate(Eigen::VectorXd const& increment) = 0;
  virtual Evaluation refine(Eigen::VectorXd const& increment) = 0;
  virtual Evaluation evaluate_committed() = 0;
  virtual void ground_stiffness(Eigen::VectorXd const& increment, std::vector<VoigtTangent<Dim>> const& tangents,
                                GroundStiffness& stiffness) const = 0;
  virtual double residual(Eigen::VectorXd const& unbalanced) const = 0;
  virtual double residual_beside(Eigen::VectorXd const& unbalanced) const = 0;
  virtual void commit(Eigen::VectorXd const& increment) = 0;

 protected:
  IncrementalProblem() = default;
  IncrementalProblem(IncrementalProblem const&) = delete;  // sessions and stiffnesses refer to it
  IncrementalProblem& operator=(IncrementalProblem const&) = delete;
};

/// An `IncrementalProblem` with something attached to the mesh.
template <int Dim>
class AttachedProblem : public IncrementalProblem<Dim> {
 public:
  static constexpr bool is_bare = false;

  virtual int first_beside() const = 0;
  virtual double length() const = 0;
  virtual Eigen::VectorXd attached_forces(Eigen::VectorXd const& increment) = 0;
  virtual Eigen::SparseMatrix<double> attached_stiffness() const = 0;
  virtual Eigen::SparseMatrix<double> stick_stiffness() const = 0;
};

}  // namespace scarp

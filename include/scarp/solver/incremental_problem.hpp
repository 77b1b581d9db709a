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
  static constexpr int dim = Dim;  ///< of space

  virtual ~IncrementalProblem() = default;

  virtual int dof_count() const = 0;                   ///< Degrees of freedom of the mesh, then of what is attached.
  virtual Constraints const& constraints() const = 0;  ///< Prescribed displacements [m] by load factor.
  virtual LoadHistory const& loads() const = 0;        ///< External forces [N] by load factor.
  /// Displacement gradient of the increment that each point saw last.
  virtual std::vector<Gradient<Dim>> const& gradients() const = 0;
  /// Stress [Pa] and verdict of each point in the last evaluation.
  virtual std::vector<Response<Dim>> const& responses() const = 0;
  /// Cauchy stress [Pa] of each point, tension positive.
  virtual std::vector<VoigtStress<Dim>> committed_stresses() const = 0;
  virtual bool have_exact_tangents()
      const = 0;  ///< Whether all points' trial tangents are derivatives of their responses.
  /// Of each point, [Pa] for engineering strain.
  virtual std::vector<VoigtTangent<Dim>> committed_tangents() const = 0;
  virtual std::vector<VoigtTangent<Dim>> trial_tangents() const = 0;  ///< Of each point in the last evaluation, [Pa].
  /// Largest component of all points' gradients in the last plan or evaluation.
  virtual double max_displacement_gradient() const = 0;
  virtual bool turns_stresses() const = 0;  ///< Whether the rotation in a gradient turns the committed stress.

  virtual void set_load(double load) = 0;  ///< Forces are measured against the loads at this load factor.
  /// Fixes the work of every point for the load step from a predicted increment [m].
  /// \param increment shape (dof_count)
  /// \param worst_point a point of the element that the increment turns inside out, -1 for none
  virtual Verdict plan(Eigen::VectorXd const& increment, int* worst_point = nullptr) = 0;
  /// Responses of all points to an increment [m] from the committed state, and the forces [N].
  virtual Evaluation evaluate(Eigen::VectorXd const& increment) = 0;
  /// Repeats the last evaluation with more inner steps for points that have not converged.
  virtual Evaluation refine(Eigen::VectorXd const& increment) = 0;
  virtual Evaluation evaluate_committed() = 0;  ///< Forces [N] of the committed state.
  /// Derivative of the elements' forces [N/m] at the increment of the last evaluation, from tangents [Pa] of all points.
  virtual void ground_stiffness(Eigen::VectorXd const& increment, std::vector<VoigtTangent<Dim>> const& tangents,
                                GroundStiffness& stiffness) const = 0;
  /// Relative imbalance of unbalanced forces [N], the largest of all parts, without unit.
  virtual double residual(Eigen::VectorXd const& unbalanced) const = 0;
  /// Relative imbalance of an attached body alone; 0 without one.
  virtual double residual_beside(Eigen::VectorXd const& unbalanced) const = 0;
  virtual bool has_attachment() const = 0;  ///< Whether something is attached to the mesh.
  virtual int first_beside() const = 0;     ///< First degree of freedom behind those of the mesh.
  virtual double length() const = 0;        ///< Size [m] of an attached body, of the mesh where it has none.
  /// Forces [N] of what is attached alone, at an increment [m], shape (dof_count); its trial state then belongs to it.
  virtual Eigen::VectorXd attached_forces(Eigen::VectorXd const& increment) = 0;
  /// Derivative of these forces [N/m] where they were requested last, shape (dof_count, dof_count).
  virtual Eigen::SparseMatrix<double> attached_stiffness() const = 0;
  /// Stiffness [N/m] as if no contact slid, shape (dof_count, dof_count).
  virtual Eigen::SparseMatrix<double> stick_stiffness() const = 0;
  /// Makes the increment [m] of the last evaluation and the points' trial states the committed ones.
  /// \throws InputError for another increment
  virtual void commit(Eigen::VectorXd const& increment) = 0;

 protected:
  IncrementalProblem() = default;
  IncrementalProblem(IncrementalProblem const&) = delete;  // sessions and stiffnesses refer to it
  IncrementalProblem& operator=(IncrementalProblem const&) = delete;
};

}  // namespace scarp

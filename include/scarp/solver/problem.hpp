// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/bvp/attached_field.hpp"
#include "scarp/bvp/attachment.hpp"
#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/grid.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/solver/detail/body_following.hpp"
#include "scarp/solver/detail/ground_stiffness.hpp"
#include "scarp/solver/detail/part_residuals.hpp"
#include "scarp/solver/linear_system.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

/// A boundary-value problem in increments: elements, materials, constraints and loads that follow a load factor, and
/// perhaps something attached to the mesh. Solvers and load stepping know nothing else, whatever the parts are made of.
template <int Dim>
class SCARP_EXPORT Problem {
 public:
  static constexpr int dim = Dim;  ///< of the mesh

  /// loads [N], shape (degrees of freedom of mesh, body and field); follow: what an attached body needs
  /// \throws InputError for sizes that do not fit together
  Problem(std::unique_ptr<Grid<Dim>> grid, MaterialPoints<Dim> points, Constraints constraints, LoadHistory loads,
          Executor& executor, detail::Attachments<Dim> attached = {}, detail::MakeFollowing<Problem> follow = nullptr)
      : attached_(std::move(attached)),
        follow_(follow),
        grid_(detail::present(std::move(grid))),
        points_(std::move(points)),
        executor_(executor),
        constraints_(std::move(constraints)),
        loads_(std::move(loads)),
        residuals_(*grid_, constraints_, first_of_field()) {
    if (points_.size() != grid_->point_count())
      reject("materials are given for {} points (the mesh has {}): make points of all sites", points_.size(),
             grid_->point_count());
    if (loads_.size() == 0) loads_ = LoadHistory(Eigen::VectorXd::Zero(dof_count()));
    if (loads_.size() != dof_count() || constraints_.dof_count() != dof_count())
      reject("loads have {} entries and constraints {} (the problem has {} degrees of freedom): size them alike",
             loads_.size(), constraints_.dof_count(), dof_count());
    attached_.require_fit(*grid_, constraints_, loads_);
    residuals_.learn(loads_);
    set_load(0.0);
  }
  Problem(Problem const&) = delete;  // sessions and stiffnesses refer to it
  Problem& operator=(Problem const&) = delete;

  /// Degrees of freedom of the mesh, then of an attached body, then of a field.
  int dof_count() const { return first_of_field() + attached_.field_dofs(); }

  bool has_attachment() const { return attached_.part != nullptr; }  ///< Whether a body or a load is attached.
  bool has_field() const { return attached_.field != nullptr; }      ///< Whether a `FieldAttachment` is attached.
  detail::AttachedField<Dim> const* field() const { return attached_.field.get(); }  ///< A field of any type, or null.
  /// What is attached to the mesh. \throws InputError unless it is of this type
  template <class Part>
  Part const& attached() const {
    if (auto const* found = attached_.template find<Part>()) return *found;
    reject("what is attached to the mesh is requested as another type: take the one that was given");
  }
  int first_beside() const { return grid_->dof_count(); }  ///< First degree of freedom behind those of the mesh.
  int first_of_field() const { return first_beside() + attached_.part_dofs(); }  ///< Behind those of mesh and body.
  /// A degree of freedom in words.
  std::string describe_dof(int dof) const {
    bool const is_of_field = has_field() && dof >= first_of_field();
    return is_of_field ? field()->describe(dof - first_of_field()) : scarp::describe_dof(*grid_, dof);
  }
  /// Size [m] of an attached body, of the mesh where it has none.
  double length() const { return attached_.length().value_or(extent<Dim>(grid_->nodes())); }
  /// Forces [N] of a body or load at an increment [m], shape (dof_count); its trial state then belongs to it.
  Eigen::VectorXd attached_forces(Eigen::VectorXd const& increment) {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(dof_count());
    if (has_attachment()) static_cast<void>(attached_.part->add_forces(grid_->positions(), increment, forces));
    return forces;
  }
  /// Derivative of these forces [N/m] where they were requested last, shape (dof_count, dof_count).
  SparseMatrix attached_stiffness() const { return attached_.part_stiffness(dof_count()); }
  detail::MakeFollowing<Problem> following() const { return follow_; }  ///< For `LinearisedStep`; null without a body.
  /// Stiffness [N/m] as if no contact slid, shape (dof_count, dof_count).
  SparseMatrix stick_stiffness() const { return attached_.stick_stiffness(dof_count()); }
  /// Derivative of a field's forces [N/m] where they were requested last, shape (dof_count, dof_count).
  SparseMatrix field_stiffness() const { return attached_.field_stiffness(dof_count()); }

  /// Forces are measured against the loads of a load factor; a step of an attached field ends there, or elsewhere.
  void set_load(double load, std::optional<double> field_at = {}) {
    if (std::exchange(load_, load) != load) evaluated_.resize(0);
    load_now_ = loads_.at(load);
    if (has_field()) attached_.field->at(field_at.value_or(load));
  }
  /// First load factor beyond one where loads, motions or an attached field may turn; infinite beyond the last.
  double next_knot(double load) const {
    return std::min({loads_.next_knot(load), constraints_.next_knot(load), attached_.next_knot(load)});
  }
  double time_error() const { return has_field() ? field()->time_error().over_allowed() : 0.0; }  ///< Over allowed.
  Grid<Dim> const& grid() const { return *grid_; }               ///< Mesh and elements, committed.
  MaterialPoints<Dim> const& points() const { return points_; }  ///< Materials with committed and trial states.
  MaterialPoints<Dim>& points() { return points_; }  ///< For callers that exchange states between load steps.
  Constraints const& constraints() const { return constraints_; }  ///< Prescribed displacements [m].
  /// Without a prescribed displacement, increasing; those of a field are not among them.
  std::vector<int> const& free_dofs() const { return residuals_.whole.free_dofs; }
  LoadHistory const& loads() const { return loads_; }     ///< Forces [N] by load factor.
  Executor const& executor() const { return executor_; }  ///< Runs the points' tasks; outlives the problem.
  /// Displacement gradients that the points saw in the last evaluation.
  std::vector<Gradient<Dim>> const& gradients() const { return points_.gradients(); }
  /// Stress [Pa], tension positive, and verdict of each point in the last evaluation.
  std::vector<Response<Dim>> const& responses() const { return points_.responses(); }
  /// Gradients of the elements in the last plan or evaluation: those that points see, or see means of.
  std::vector<Gradient<Dim>> const& own_gradients() const { return points_.own_gradients(); }
  /// Cauchy stress [Pa] of each point, tension positive, without what a field of means adds.
  std::vector<VoigtStress<Dim>> committed_stresses() const { return points_.committed_stresses(executor_); }
  /// Committed stresses [Pa] with what a field of means adds: those that balance the loads.
  std::vector<VoigtStress<Dim>> balanced_stresses() const { return points_.balanced_stresses(executor_); }

  /// Largest component of all points' gradients in the last plan or evaluation.
  double max_displacement_gradient() const {
    double largest = 0.0;
    for (auto const& gradient : gradients()) largest = std::max(largest, gradient.cwiseAbs().maxCoeff());
    return largest;
  }
  bool turns_stresses() const { return grid_->turns_stresses(); }  ///< Whether rotations turn the stress that is there.

  /// Fixes every point's work for the load step from a predicted increment [m], shape (dof_count), and its gradient.
  /// \param worst_point where given, a point of the element that the increment turns inside out, -1 for none
  Verdict plan(Eigen::VectorXd const& increment, int* worst_point = nullptr) {
    Verdict const verdict = look(increment, worst_point);
    if (verdict.acceptable()) points_.plan();
    return verdict;
  }

  /// Lets every point respond to an increment from its committed state and adds up the forces.
  Evaluation evaluate(Eigen::VectorXd const& increment) {
    Evaluation evaluation;
    evaluation.verdict = look(increment, &evaluation.worst_point);
    if (!evaluation.verdict.acceptable()) return evaluation;
    static_cast<ResponseReport&>(evaluation) = points_.evaluate(executor_);
    evaluated_ = increment;
    add_up(increment, evaluation);
    return evaluation;
  }

  /// Evaluates the points whose last response is not converged with more inner steps, now and for the rest of the load
  /// step, at the increment of the last evaluation.
  /// \throws InputError for another increment
  Evaluation refine(Eigen::VectorXd const& increment) {
    require_evaluated("refined", increment);
    Evaluation evaluation{points_.refine(executor_)};
    add_up(increment, evaluation);
    return evaluation;
  }

  /// Forces of the committed state.
  Evaluation evaluate_committed() {
    points_.evaluate_committed(executor_);
    forget();
    Evaluation evaluation;
    add_up(Eigen::VectorXd::Zero(dof_count()), evaluation);
    residuals_.whole.largest_scale =
        std::max(residuals_.whole.largest_scale, residuals_.whole.scale(evaluation.unbalanced, load_now_));
    return evaluation;
  }

  /// Stiffness [N/m] of the elements at the increment of the last evaluation, with its stresses. Where points see means
  /// it refers to this problem, and is void once these means are replaced.
  void ground_stiffness(Eigen::VectorXd const& increment, std::vector<VoigtTangent<Dim>> const& tangents,
                        GroundStiffness& stiffness) const {
    detail::ground_stiffness(*grid_, points_, executor_, of_nodes(increment), tangents, stiffness);
    stiffness.own.conservativeResize(dof_count(), dof_count());
  }

  /// Largest of all parts' residuals of unbalanced forces [N], without unit, see `residuals`.
  double residual(Eigen::VectorXd const& unbalanced) const {
    return std::max(force_residual(unbalanced), attached_.field_residual(unbalanced));
  }
  /// That of all parts but a field.
  double force_residual(Eigen::VectorXd const& unbalanced) const {
    return residuals_.largest(unbalanced, load_now_, load_);
  }

  /// Imbalance by parts: "all" is |unbalanced| over free degrees of freedom, over the largest of |reactions|, |loads|
  /// and what the elements and the attachment carried there last, Euclidean norms, or a thousandth of the largest that
  /// a committed state had, since an unloaded body has none. Then follows each region of the mesh that is held nowhere,
  /// by its name, unless it is the only one, as a rigid body, and "attached", each over its own loads (0 without them);
  /// a field has its own name and measure, and is no part of the whole.
  std::vector<PartResidual> residuals(Eigen::VectorXd const& unbalanced) const {
    auto parts = residuals_.list(unbalanced, load_now_, load_, has_attachment());
    if (has_field()) parts.push_back({field()->name(), attached_.field_residual(unbalanced)});
    return parts;
  }

  /// Residual of a body over its own loads, which reactions would hide (0 without loads).
  double residual_beside(Eigen::VectorXd const& unbalanced) const {
    return residuals_.beside(unbalanced, load_now_, load_);
  }

  bool have_exact_tangents() const { return points_.have_exact_tangents(); }  ///< Whether all are derivatives.
  /// Tangents of all points' committed states.
  std::vector<VoigtTangent<Dim>> committed_tangents() const { return points_.committed_tangents(executor_); }
  /// Tangents of all points' trial states, which belong to the last evaluation.
  std::vector<VoigtTangent<Dim>> trial_tangents() const { return points_.tangents(executor_); }

  /// Makes the increment and the points' trial states the committed ones.
  /// \throws InputError unless the increment is the last one that was evaluated: trial states belong to that one
  void commit(Eigen::VectorXd const& increment) {
    require_evaluated("committed", increment);
    points_.commit();  // first, since it may throw
    forget();
    attached_.commit(grid_->positions(), increment);
    grid_->commit(of_nodes(increment));
  }

  /// \throws InputError for an attachment that cannot be saved
  void require_described() const {
    StateWriter writer;
    attached_.write(writer);
  }
  /// What evolves from step to step: a new problem with these resumes as the one that they were saved from.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("discretisation", *self.grid_);
    visit("materials", self.points_);
    visit("largest_scale", self.residuals_.whole.largest_scale);
    detail::Attachments<Dim>::members(self.attached_, visit);
  }
  void after_loading() { forget(); }  ///< The next evaluation computes all gradients anew.

 private:
  void forget() { seen_ = evaluated_ = Eigen::VectorXd(); }
  void require_evaluated(std::string_view what, Eigen::VectorXd const& increment) const {
    if (evaluated_.size() == increment.size() && evaluated_ == increment) return;
    reject("the increment to be {} is not the one that was evaluated last: evaluate it first, and commit it once",
           what);
  }
  Eigen::VectorXd of_nodes(Eigen::VectorXd const& increment) const { return increment.head(grid_->dof_count()); }

  /// Shows the points an increment, unless it is not finite or turns an element inside out.
  Verdict look(Eigen::VectorXd const& increment, int* worst_point) {
    if (worst_point) *worst_point = -1;
    if (!increment.allFinite()) return {Status::failed, Reason::not_finite};
    if (seen_.size() == increment.size() && seen_ == increment) return {};
    std::vector<Gradient<Dim>> gradients(detail::index(grid_->point_count()));
    if (auto const inverted = grid_->gradients(of_nodes(increment), gradients)) {
      if (worst_point) *worst_point = grid_->first_point(*inverted);
      return {Status::failed, Reason::element_inverted};
    }
    evaluated_.resize(0);
    points_.set_gradients(std::move(gradients), executor_);
    seen_ = increment;
    return {};
  }

  void add_up(Eigen::VectorXd const& increment, Evaluation& evaluation) {
    grid_->internal_force(of_nodes(increment), points_.stresses(), evaluation.unbalanced);
    evaluation.unbalanced.conservativeResizeLike(Eigen::VectorXd::Zero(dof_count()));
    residuals_.whole.carried = 0.0;
    residuals_.whole.carry(evaluation.unbalanced);
    Eigen::VectorXd const of_elements = evaluation.unbalanced;
    Verdict const verdict = attached_.add_forces(grid_->positions(), increment, evaluation.unbalanced);
    if (evaluation.verdict.acceptable()) evaluation.verdict = verdict;
    residuals_.whole.carry(evaluation.unbalanced - of_elements);
    evaluation.unbalanced -= load_now_;
    evaluation.residual = residual(evaluation.unbalanced);
    if (has_attachment() || has_field() || residuals_.has_regions())
      evaluation.parts = residuals(evaluation.unbalanced);
    bool const finite = std::isfinite(evaluation.residual) && evaluation.unbalanced.allFinite();
    if (!finite && evaluation.verdict.acceptable()) evaluation.verdict = {Status::failed, Reason::not_finite};
  }

  detail::Attachments<Dim> attached_;
  detail::MakeFollowing<Problem> follow_;
  std::unique_ptr<Grid<Dim>> grid_;
  MaterialPoints<Dim> points_;
  Executor const& executor_;
  Constraints constraints_;
  LoadHistory loads_;
  double load_ = 0.0;  ///< factor
  Eigen::VectorXd load_now_;
  Eigen::VectorXd seen_;       ///< increment whose gradients the points have; empty after a commit
  Eigen::VectorXd evaluated_;  ///< increment that the points' trial states belong to; empty after a commit
  detail::ForceResiduals<Dim> residuals_;
};

#ifdef SCARP_PRECOMPILED
extern template class Problem<2>;
extern template class Problem<3>;
#endif

}  // namespace scarp

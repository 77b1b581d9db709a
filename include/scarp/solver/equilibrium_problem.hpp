// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "scarp/bvp/attachment.hpp"
#include "scarp/bvp/averaged_stiffness.hpp"
#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/constitutive/material_field.hpp"
#include "scarp/element/index.hpp"
#include "scarp/solver/evaluation.hpp"
#include "scarp/solver/executor.hpp"

namespace scarp {

/// A boundary-value problem in increments: discretisation, materials, constraints and loads that follow a load factor, and
/// perhaps something attached to the mesh.
template <class DiscretisationType, MaterialField Materials, class Executor, class Attached = NoAttachment>
class EquilibriumProblem {
 public:
  static constexpr int dim = DiscretisationType::dim;
  static constexpr bool follows_motion = DiscretisationType::follows_motion;
  static constexpr bool is_bare = std::is_same_v<Attached, NoAttachment>;
  static constexpr bool averages = AveragesGradients<Materials>;

  /// loads [N], shape (degrees of freedom of mesh and attachment)
  /// \throws InputError for sizes that do not fit together
  EquilibriumProblem(DiscretisationType discretisation, Materials materials, Constraints constraints, LoadHistory loads,
                     Executor& executor, Attached attached = {})
      : discretisation_(std::move(discretisation)),
        materials_(std::move(materials)),
        constraints_(std::move(constraints)),
        loads_(std::move(loads)),
        executor_(executor),
        attached_(std::move(attached)),
        free_dofs_(constraints_.free_dofs()),
        gradients_(points()),
        responses_(points()),
        works_(points()) {
    for (int point = 0; point < discretisation_.point_count(); ++point) {
      if (owns_point(executor_, point)) owned_.push_back(point);
    }
    if (materials_.point_count() != discretisation_.point_count()) {
      refuse("materials are given for {} points (the mesh has {}): make one field over all sites",
             materials_.point_count(), discretisation_.point_count());
    }
    if (loads_.size() != dof_count() || constraints_.dof_count() != dof_count()) {
      refuse("loads have {} entries and constraints {} (the problem has {} degrees of freedom): size them alike",
             loads_.size(), constraints_.dof_count(), dof_count());
    }
    aim(0.0);
  }

  int dof_count() const {
    if constexpr (is_bare) {
      return discretisation_.dof_count();
    } else {
      return discretisation_.dof_count() + attached_.extra_dofs();
    }
  }

  /// Sets the load factor whose loads the forces are measured against from now on.
  void aim(double load) { load_now_ = loads_.at(load); }

  DiscretisationType const& discretisation() const { return discretisation_; }
  Materials const& materials() const { return materials_; }
  Constraints const& constraints() const { return constraints_; }
  std::vector<int> const& free_dofs() const { return free_dofs_; }
  LoadHistory const& loads() const { return loads_; }
  Executor& executor() const { return executor_; }
  Attached const& attached() const { return attached_; }

  /// Gradients that the points have seen in the last evaluation, and their answers.
  std::vector<Gradient<dim>> const& gradients() const { return gradients_; }
  std::vector<Response<dim>> const& responses() const { return responses_; }

  std::vector<VoigtStress<dim>> committed_stresses() const {
    std::vector<VoigtStress<dim>> values(points());
    for (int const point : owned_) values[detail::index(point)] = materials_.committed_stress(point);
    share(values);
    return values;
  }

  /// Largest component of all points' gradients in the last plan or evaluation.
  double largest_gradient() const {
    double largest = 0.0;
    for (auto const& gradient : gradients_) largest = std::max(largest, gradient.cwiseAbs().maxCoeff());
    return largest;
  }

  /// Fixes every point's work for the load step from a predicted increment; the points' gradients are kept.
  Verdict plan(Eigen::VectorXd const& increment) {
    if (!increment.allFinite()) return {Status::failed, Reason::not_finite};
    if (discretisation_.gradients(of_nodes(increment), gradients_)) return {Status::failed, Reason::element_inverted};
    if constexpr (averages) materials_.average(gradients_);
    for (int const point : owned_) materials_.plan(point, gradients_[detail::index(point)]);
    return {};
  }

  /// Lets every point respond to an increment from its committed state and adds up the forces.
  Evaluation evaluate(Eigen::VectorXd const& increment) {
    return evaluated(increment, [&](int point) { return materials_.respond(point, gradients_[detail::index(point)]); });
  }

  /// The same, each point going on from its trial state at the increment of the last evaluation: it follows the path of the
  /// iteration and works for the change only.
  Evaluation advance(Eigen::VectorXd const& increment) requires AdvancesTrials<Materials> {
    std::vector<Gradient<dim>> const last = gradients_;
    return evaluated(increment, [&](int point) {
      Gradient<dim> const further = further_gradient(last[detail::index(point)], gradients_[detail::index(point)]);
      materials_.plan_advance(point, further);
      return materials_.advance(point, further);
    });
  }

  /// Lets the points whose last answer is not converged work harder, now and for the rest of the load step, at the increment
  /// of the last evaluation.
  Evaluation refine(Eigen::VectorXd const& increment) {
    return refined(increment, [&](int point) { return materials_.respond(point, gradients_[detail::index(point)]); });
  }

  /// Lets them work on from their trial states, without further strain.
  Evaluation rest(Eigen::VectorXd const& increment) requires AdvancesTrials<Materials> {
    return refined(increment, [&](int point) { return materials_.advance(point, Gradient<dim>::Zero()); });
  }

  /// Forces of the committed state.
  Evaluation evaluate_committed() {
    auto const committed = committed_stresses();
    for (std::size_t k = 0; k < points(); ++k) {
      gradients_[k].setZero();
      responses_[k] = {committed[k], {}};
    }
    if constexpr (averages) materials_.average(gradients_);
    Evaluation evaluation;
    add_up(Eigen::VectorXd::Zero(dof_count()), evaluation);
    return evaluation;
  }

  /// Stiffness [N/m] of the elements at the increment of the last evaluation, with its stresses.
  void ground_stiffness(Eigen::VectorXd const& increment, std::vector<VoigtTangent<dim>> const& tangents,
                        Eigen::SparseMatrix<double>& matrix) const {
    if constexpr (averages) {
      averaged_stiffness(discretisation_, of_nodes(increment), stresses(), tangents, materials_, matrix);
    } else {
      discretisation_.stiffness(of_nodes(increment), stresses(), tangents, matrix);
    }
    if constexpr (!is_bare) matrix.conservativeResize(dof_count(), dof_count());
  }

  /// Forces [N] of what is attached alone, at an increment; its trial state then belongs to that increment. Whether it could
  /// answer is said by the next evaluation.
  Eigen::VectorXd attached_forces(Eigen::VectorXd const& increment) requires(!is_bare) {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(dof_count());
    attached_.add_forces(discretisation_.positions(), increment, forces);
    return forces;
  }

  /// Their derivative [N/m] where they were asked for last.
  Eigen::SparseMatrix<double> attached_stiffness() const requires(!is_bare) {
    return assembled([&](auto& entries) { attached_.add_stiffness(entries); });
  }

  /// The same as if nothing there slid.
  Eigen::SparseMatrix<double> held_stiffness() const requires(!is_bare) {
    if constexpr (requires(std::vector<Eigen::Triplet<double>> & entries) { attached_.add_held_stiffness(entries); }) {
      return assembled([&](auto& entries) { attached_.add_held_stiffness(entries); });
    } else {
      return attached_stiffness();
    }
  }

  /// \return |unbalanced| over free dofs / |reactions|, Euclidean norms; where that is larger, that of what stands on the mesh
  /// over its loads
  double residual(Eigen::VectorXd const& unbalanced) const {
    double free = 0.0;
    for (int const dof : free_dofs_) free += unbalanced(dof) * unbalanced(dof);
    double prescribed = 0.0;
    for (int const dof : constraints_.prescribed_dofs()) prescribed += unbalanced(dof) * unbalanced(dof);
    // A body held nowhere has no reactions: measure against the loads.
    double const scale = prescribed > 0.0 ? prescribed : load_now_.squaredNorm();
    double const all = free == 0.0 ? 0.0 : std::sqrt(free / scale);
    if constexpr (is_bare) {
      return all;
    } else {
      return std::max(all, residual_beside(unbalanced));
    }
  }

  /// Imbalance of a body beside the mesh relative to its own loads: the reactions of a heavy ground would hide it.
  /// 0 without such a body or loads.
  double residual_beside(Eigen::VectorXd const& unbalanced) const {
    int const first = discretisation_.dof_count();
    double free = 0.0;
    for (int const dof : free_dofs_) free += dof < first ? 0.0 : unbalanced(dof) * unbalanced(dof);
    double const scale = load_now_.tail(dof_count() - first).norm();
    return free == 0.0 || scale == 0.0 ? 0.0 : std::sqrt(free) / scale;
  }

  /// Tangents of all points' committed states.
  std::vector<VoigtTangent<dim>> committed_tangents() const {
    return all_tangents([&](int point) { return materials_.committed_tangent(point); });
  }

  /// Tangents of all points' trial states, which belong to the last evaluation.
  std::vector<VoigtTangent<dim>> trial_tangents() const {
    return all_tangents([&](int point) { return materials_.trial_tangent(point); });
  }

  /// Makes the increment and the points' trial states the committed ones.
  void commit(Eigen::VectorXd const& increment) {
    if constexpr (!is_bare) attached_.commit(discretisation_.positions(), increment);
    discretisation_.commit(of_nodes(increment));
    materials_.commit();
  }

  /// visit(state) may change the points' committed states; between runs only, since a solver's session remembers tangents.
  template <class Visit>
  void for_each_committed(Visit&& visit) {
    materials_.for_each_committed(visit);
  }

  /// What evolves from step to step: a problem made anew goes on from these as the one that they were taken from.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("discretisation", self.discretisation_);
    visit("materials", self.materials_);
    if constexpr (!is_bare) visit("attached", self.attached_);
  }

 private:
  static_assert(is_bare || Attachment<Attached, dim>);

  decltype(auto) of_nodes(Eigen::VectorXd const& increment) const {
    if constexpr (is_bare) {
      return (increment);
    } else {
      return Eigen::VectorXd(increment.head(discretisation_.dof_count()));
    }
  }

  template <class Add>
  Eigen::SparseMatrix<double> assembled(Add const& add) const {
    std::vector<Eigen::Triplet<double>> entries;
    add(entries);
    Eigen::SparseMatrix<double> matrix(dof_count(), dof_count());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// Completes an array over all points by what other processes know.
  template <class Value>
  void share(std::vector<Value>& values) const {
    if constexpr (SharesPoints<Executor>) executor_.share(values);
  }

  std::size_t points() const { return static_cast<std::size_t>(discretisation_.point_count()); }

  std::vector<VoigtStress<dim>> stresses() const {
    std::vector<VoigtStress<dim>> values(points());
    for (std::size_t k = 0; k < points(); ++k) values[k] = responses_[k].stress;
    if constexpr (averages) {
      if (materials_.mean().is_local()) return values;
      for (std::size_t k = 0; k < points(); ++k) values[k] += materials_.added_stresses()[k];
    }
    return values;
  }

  /// Gradient from one configuration of the load step to another, both given from its start.
  static Gradient<dim> further_gradient(Gradient<dim> const& from, Gradient<dim> const& to) {
    if constexpr (follows_motion) {
      Gradient<dim> const unit = Gradient<dim>::Identity();
      return (unit + to) * (unit + from).inverse() - unit;
    } else {
      return to - from;
    }
  }

  template <class Answer>
  Evaluation evaluated(Eigen::VectorXd const& increment, Answer const& answer) {
    Evaluation evaluation;
    if (!increment.allFinite()) {
      evaluation.verdict = {Status::failed, Reason::not_finite};
      return evaluation;
    }
    if (auto const inverted = discretisation_.gradients(of_nodes(increment), gradients_)) {
      evaluation.verdict = {Status::failed, Reason::element_inverted};
      evaluation.worst_point = *inverted * DiscretisationType::points_per_element;
      return evaluation;
    }
    if constexpr (averages) materials_.average(gradients_);
    respond(owned_, answer, evaluation);
    add_up(increment, evaluation);
    return evaluation;
  }

  template <class Answer>
  Evaluation refined(Eigen::VectorXd const& increment, Answer const& answer) {
    std::vector<int> unconverged;
    for (int const point : owned_) {
      if (responses_[detail::index(point)].verdict.status == Status::not_converged) unconverged.push_back(point);
    }
    // A point that cannot work harder would only repeat its answer.
    std::erase_if(unconverged, [&](int point) {
      long const before = materials_.work(point);
      materials_.refine_plan(point);
      return materials_.work(point) == before;
    });
    Evaluation evaluation;
    respond(unconverged, answer, evaluation);
    add_up(increment, evaluation);
    return evaluation;
  }

  /// selected: points of this process
  template <class Answer>
  void respond(std::vector<int> const& selected, Answer const& answer, Evaluation& evaluation) {
    constexpr long not_asked = -1;
    std::vector<long> worked(points(), not_asked);
    executor_.for_each(static_cast<int>(selected.size()), [&](int task) {
      int const point = selected[detail::index(task)];
      auto const k = detail::index(point);
      responses_[k] = answer(point);
      // Prescribed nodes would hide a NaN from the residual of the free ones.
      if (!responses_[k].stress.allFinite()) responses_[k].verdict = {Status::failed, Reason::not_finite};
      worked[k] = materials_.work(point);
    });
    share(responses_);
    share(worked);
    for (int point = 0; point < discretisation_.point_count(); ++point) {
      Verdict const verdict = responses_[detail::index(point)].verdict;
      long& work = works_[detail::index(point)];
      if (long const now = worked[detail::index(point)]; now != not_asked) {
        work = now;
        evaluation.inner_steps += now;
      }
      evaluation.points.add(point, verdict.status, work);
      if (!verdict.acceptable() && (evaluation.worst_point < 0 || verdict.status > evaluation.verdict.status)) {
        evaluation.verdict = verdict;
        evaluation.worst_point = point;
      }
    }
  }

  template <class TangentOf>
  std::vector<VoigtTangent<dim>> all_tangents(TangentOf const& tangent_of) const {
    std::vector<VoigtTangent<dim>> values(points());
    executor_.for_each(static_cast<int>(owned_.size()), [&](int task) {
      int const point = owned_[detail::index(task)];
      values[detail::index(point)] = tangent_of(point);
    });
    share(values);
    return values;
  }

  void add_up(Eigen::VectorXd const& increment, Evaluation& evaluation) {
    discretisation_.internal_force(of_nodes(increment), stresses(), evaluation.unbalanced);
    if constexpr (!is_bare) {
      evaluation.unbalanced.conservativeResizeLike(Eigen::VectorXd::Zero(dof_count()));
      Verdict const verdict = attached_.add_forces(discretisation_.positions(), increment, evaluation.unbalanced);
      if (evaluation.verdict.acceptable()) evaluation.verdict = verdict;
    }
    evaluation.unbalanced -= load_now_;
    evaluation.residual = residual(evaluation.unbalanced);
    if (!std::isfinite(evaluation.residual) && evaluation.verdict.acceptable()) {
      evaluation.verdict = {Status::failed, Reason::not_finite};
    }
  }

  DiscretisationType discretisation_;
  Materials materials_;
  Constraints constraints_;
  LoadHistory loads_;
  Eigen::VectorXd load_now_;
  Executor& executor_;
  Attached attached_;
  std::vector<int> free_dofs_;
  std::vector<Gradient<dim>> gradients_;
  std::vector<Response<dim>> responses_;
  std::vector<long> works_;  ///< inner steps of the points' last answers
  std::vector<int> owned_;   ///< points of this process
};

}  // namespace scarp

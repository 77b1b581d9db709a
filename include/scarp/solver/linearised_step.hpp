// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "scarp/solver/detail/body_following.hpp"
#include "scarp/solver/linear_system.hpp"
#include "scarp/solver/problem.hpp"
#include "scarp/solver/step_report.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// The displacement at which a linearised ground and what is attached to it balance the loads. The attachment has its
/// own forces: contact that opens, closes or slides is followed here, where no material point is evaluated. A field is
/// part of the ground. Without bodies and loads this is one linear solve.
template <int Dim>
class LinearisedStep {
  using Problem = scarp::Problem<Dim>;

 public:
  static constexpr double singular = 1e15;  ///< condition beyond which no digit of a solution is left

  /// accuracy: residual below which the attachment's forces need no further correction
  LinearisedStep(Problem& problem, double accuracy, LinearSolverFactory solver = sparse_lu)
      : problem_(problem), system_(problem.constraints(), std::move(solver)) {
    if (auto const make = problem.following()) contact_ = make(problem, system_, accuracy);
  }
  LinearisedStep(LinearisedStep const&) = delete;  // what follows contact refers to the system
  LinearisedStep& operator=(LinearisedStep const&) = delete;

  /// Linearises about the increment [m] of the problem's last evaluation, whose unbalanced forces [N] are given.
  Verdict linearise(Eigen::VectorXd const& increment, Eigen::VectorXd const& unbalanced,
                    std::vector<VoigtTangent<Dim>> const& tangents) {
    problem_.ground_stiffness(increment, tangents, ground_.stiffness);
    ground_.centre = increment;
    ground_.forces = unbalanced;
    if (contact_) ground_.forces -= problem_.attached_forces(increment);
    if (problem_.has_field()) ground_.stiffness.own += problem_.field_stiffness();
    Verdict const verdict = contact_ ? contact_->factorize(ground_) : system_.factorize(ground_.stiffness);
    is_held_ = verdict.acceptable();
    // A body that floats above its ground, as before its weight comes, is no fault yet: `solve` lets it down.
    if (contact_ && verdict.reason == Reason::singular_system && !contact_->is_held()) return {};
    return verdict;
  }

  /// About the committed state, at the load factor that the problem is aimed at.
  /// \return singular_system also where no digit of a solution is left
  Verdict linearise_committed(std::vector<VoigtTangent<Dim>> const& tangents) {
    Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem_.dof_count());
    Verdict verdict = linearise(still, problem_.evaluate_committed().unbalanced, tangents);
    committed_condition_ = is_held_ ? system_.condition() : 0.0;
    if (committed_condition_ > singular) verdict = {Status::failed, Reason::singular_system};
    committed_weak_dof_ = verdict.reason == Reason::singular_system ? system_.weakest_dof() : -1;
    return verdict;
  }
  /// Adds what was found out about the committed state: a condition of 0 where a body floats.
  void describe(StepReport& report) const {
    report.condition = committed_condition_;
    report.weak_dof = committed_weak_dof_;
  }

  /// Moves an increment [m], kept at its prescribed entries, to where forces balance when the loads have grown by
  /// `more` [N] since the linearisation. What cannot be balanced is left to the next linearisation.
  Verdict solve(Eigen::VectorXd& increment, Eigen::VectorXd const& more) {
    return contact_ ? contact_->follow(ground_, increment, more)
                    : system_.correct(increment, ground_.unbalanced(increment, more));
  }

  LinearSystem const& system() const { return system_; }  ///< Equations of the last matrix.

 private:
  Problem& problem_;
  LinearSystem system_;
  detail::LinearisedGround ground_;
  std::unique_ptr<detail::BodyFollowing> contact_;  ///< null unless bodies are attached
  double committed_condition_ = 0.0;
  int committed_weak_dof_ = -1;
  bool is_held_ = false;  ///< all bodies, when the system was linearised
};

}  // namespace scarp

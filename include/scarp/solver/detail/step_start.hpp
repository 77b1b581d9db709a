// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/solver/detail/linearised_step.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

namespace detail {
/// How the free degrees of freedom moved in the last accepted load step, for each unit of the load factor.
class RepeatedMotion {
 public:
  bool known() const { return !rate_.empty(); }
  void forget() { rate_.clear(); }

  /// motion [m]: of the free degrees of freedom in a step; growth: of the load factor, positive
  void remember(Eigen::VectorXd const& motion, double growth) {
    rate_.resize(static_cast<std::size_t>(motion.size()));
    rate() = motion / growth;
  }

  /// The motion [m] when the load factor grows by as much.
  Eigen::VectorXd over(double growth) { return growth * rate(); }

  SCARP_MEMBERS(rate_)

 private:
  Eigen::Map<Eigen::VectorXd> rate() { return {rate_.data(), static_cast<Eigen::Index>(rate_.size())}; }

  std::vector<double> rate_;  ///< [m]
};
}  // namespace detail

/// What a load step begins with, however it is iterated afterwards: the system linearised about the committed state, what is
/// known of it, and the first guess that follows from it.
template <class Problem, LinearSolver Linear>
class StepStart {
 public:
  /// accuracy: see LinearisedStep
  StepStart(Problem& problem, double accuracy) : problem_(problem), linearised_(problem, accuracy) {}

  /// At the load factor that the problem is aimed at; says which degree of freedom is weak where the system is singular.
  Verdict linearise(std::vector<VoigtTangent<Problem::dim>> const& tangents) {
    Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem_.dof_count());
    Verdict verdict = linearised_.linearise(still, problem_.evaluate_committed().unbalanced, tangents);
    condition_ = verdict.acceptable() ? linearised_.condition() : 0.0;
    if (condition_ > linearised_.singular) verdict = {Status::failed, Reason::singular_system};
    weak_dof_ = verdict.reason == Reason::singular_system ? linearised_.weak_dof() : -1;
    return verdict;
  }

  /// Adds what was found out about the system.
  void describe(StepReport& report) const {
    report.condition = condition_;
    report.weak_dof = weak_dof_;
  }

  /// Displacement increment between two load factors where it is prescribed, zero elsewhere; from then on forces are
  /// measured against the loads of the second one.
  Eigen::VectorXd prescribed(double from, double to) {
    problem_.aim(to);
    return problem_.constraints().displacement(from, to);
  }

  /// First guess of the whole increment from the linearised system, aimed likewise.
  Eigen::VectorXd predict(double from, double to) {
    Eigen::VectorXd increment = prescribed(from, to);
    Eigen::VectorXd const more_load = problem_.loads().at(to) - problem_.loads().at(from);
    // A prediction that fails is no more than a poor first guess.
    linearised_.solve(increment, more_load);
    return increment;
  }

  LinearisedStep<Problem, Linear>& linearised() { return linearised_; }

 private:
  Problem& problem_;
  LinearisedStep<Problem, Linear> linearised_;
  double condition_ = 0.0;
  int weak_dof_ = -1;
};

}  // namespace scarp

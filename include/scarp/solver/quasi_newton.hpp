// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/solver/linear_solver.hpp"
#include "scarp/solver/linearised_step.hpp"
#include "scarp/solver/problem.hpp"
#include "scarp/solver/step_report.hpp"
#include "scarp/solver/tangent_rules.hpp"

namespace scarp {

template <class Rule, int Dim>
class QuasiNewtonSession;

/// Newton-type iteration for one load step: the tangent rule gives the points' tangents in each iteration. Every
/// iteration moves the points along the straight path from their committed states to the iterate.
template <class Rule = MaterialTangent>
  requires TangentRule<Rule, 2> || ChoosesTangentRule<Rule, 2>
struct QuasiNewton {
  /// Force residual, see Problem::residuals; without one 1e-6 where all materials have exact tangents, else 5e-3.
  std::optional<double> tolerance{};
  int max_iterations = 30;         ///< of a load step; then it is given up
  double divergence_limit = 10.0;  ///< residual beyond which a step is given up
  int max_refinements = 8;         ///< of points that have not converged, in each iteration
  /// A step's first guess is the motion of the step before, scaled by the load, and the correction of what that one
  /// left unbalanced; after a rejected one, and for a field on points with exact tangents, it is linear.
  bool repeats_motion = true;
  int tangent_interval = 4;  ///< load steps that share one evaluation of the provider's tangents
  Rule rule{};               ///< working tangent of each point
  /// Makes the solver of linear systems, whose matrices are not symmetric in general.
  LinearSolverFactory linear_solver = sparse_lu;

  /// \throws InputError for a setting outside of its range
  void validate() const {
    if (tolerance) require_positive("tolerance of the force residual", *tolerance);
    require_at_least("most iterations of a load step", max_iterations, 1);
    require_at_least("residual beyond which a step is given up", divergence_limit, tolerance.value_or(5e-3));
    require_at_least("most refinements of an iteration", max_refinements, 0);
    require_at_least("load steps that share the provider's tangents", tangent_interval, 1);
    if (!linear_solver) reject("the linear solver of an iteration is empty: give it sparse_lu or another one");
    detail::validated(rule);
  }

  /// The iteration on one problem.
  template <class Problem>
  using Session = QuasiNewtonSession<Rule, Problem::dim>;
};

/// The iteration of a `QuasiNewton` on one problem: factorisation, learned tangents.
/// \tparam Rule of the `QuasiNewton`
template <class Rule, int Dim>
class SCARP_EXPORT QuasiNewtonSession {
 public:
  static constexpr int dim = Dim;       ///< of the problem
  using Problem = scarp::Problem<Dim>;  ///< whatever its elements and materials are

  /// The problem must outlive the session. \throws InputError for a setting outside of its range
  QuasiNewtonSession(QuasiNewton<Rule> const& settings, Problem& problem)
      : settings_(detail::validated(settings)),
        problem_(problem),
        exact_(problem.have_exact_tangents()),
        tolerance_(settings.tolerance.value_or(exact_ ? 1e-6 : 5e-3)),
        repeats_motion_(settings.repeats_motion && !(exact_ && problem.has_field())),
        linearised_(problem, 0.1 * tolerance_, settings.linear_solver) {}

  /// Readies a step between two load factors from the committed state: tangents, factorisation, present imbalance.
  Verdict begin(double from, double to);
  bool begins_at_end() const { return !repeats_motion_ && problem_.has_field(); }  ///< Whether begin() depends on `to`.
  void describe(StepReport& report) const { linearised_.describe(report); }  ///< Adds what begin() found of the matrix.
  /// First guess of the increment [m] between two load factors: the last step's motion where it is known, and what that
  /// step left unbalanced; else a linear solve.
  Eigen::VectorXd predict(double from, double to);
  /// Iterates from a prediction, which ends as the increment in equilibrium, with the points' trial states.
  void correct(Eigen::VectorXd& increment, StepReport& report, StopCondition const& stop = {});
  /// Commits an increment in equilibrium; the learned tangents start the next step.
  void accept(Eigen::VectorXd const& increment);
  /// State that persists from step to step.
  SCARP_MEMBERS_EXCEPT((settings_, problem_, exact_, tolerance_, repeats_motion_, linearised_, mark_, tangent_seconds_,
                        working_, last_gradients_, last_stresses_, missing_, growth_),
                       first_, provider_, steps_of_provider_, learned_, motion_)
  /// \throws InputError for a state of another problem
  void after_loading() const {
    if (!motion_.motion_.empty()) linearised_.system().require_free(motion_.motion_.size());
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Motion {                 ///< of the free degrees of freedom in the last accepted load step
    std::vector<double> motion_;  ///< [m], less what the step before had left to it; empty where it is not known
    double growth_ = 0.0;         ///< of the load factor, positive
    SCARP_MEMBERS(motion_, growth_)
  };

  void iterate(Eigen::VectorXd& increment, StepReport& report, StopCondition const& stop);
  Evaluation recorded(StepReport& report, Eigen::VectorXd const& increment, bool refine);
  std::vector<VoigtTangent<Dim>> timed_tangents(bool of_trial_states);
  void learn();
  template <class RuleType>
  void learn_from_responses(RuleType const& rule);
  /// Calls act with the rule of this problem's materials.
  template <class Act>
  void with_rule(Act const& act) const {
    if constexpr (ChoosesTangentRule<Rule, dim>) {
      exact_ ? act(settings_.rule.exact) : act(settings_.rule.learned);
    } else {
      act(settings_.rule);
    }
  }

  QuasiNewton<Rule> settings_;
  Problem& problem_;
  bool exact_;        ///< whether all tangents of materials are derivatives
  double tolerance_;  ///< of the residual
  bool repeats_motion_;
  LinearisedStep<Dim> linearised_;
  Clock::time_point mark_{};              ///< end of the last response of the points in this step
  double tangent_seconds_ = 0.0;          ///< that no evaluation has counted yet
  std::vector<VoigtTangent<Dim>> first_;  ///< of the state that the session began with
  std::vector<VoigtTangent<Dim>> provider_;
  int steps_of_provider_ = 0;  ///< accepted since these tangents were evaluated
  std::vector<VoigtTangent<Dim>> working_;
  std::vector<VoigtTangent<Dim>> learned_;
  std::vector<Gradient<dim>> last_gradients_;
  std::vector<VoigtStress<dim>> last_stresses_;
  Motion motion_;
  Eigen::VectorXd missing_;  ///< [m] from the committed state to equilibrium; 0 without a motion
  double growth_ = 0.0;      ///< of the load factor in the last prediction
};

template <class Rule, int Dim>
Verdict QuasiNewtonSession<Rule, Dim>::begin(double from, double to) {
  problem_.set_load(from, repeats_motion_ ? from : to);  // what a field lacks at the end is its motion and no imbalance
  if (steps_of_provider_ == 0) provider_ = timed_tangents(false);
  if (first_.empty()) first_ = provider_;
  if (learned_.empty()) learned_ = provider_;
  working_.resize(provider_.size());
  with_rule([&](auto const& rule) {
    for (std::size_t k = 0; k < working_.size(); ++k) working_[k] = rule.template start<dim>(provider_[k], learned_[k]);
  });
  Verdict const verdict = linearised_.linearise_committed(working_);
  missing_ = Eigen::VectorXd::Zero(linearised_.system().free_count());
  if (verdict.acceptable() && !motion_.motion_.empty()) {
    Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem_.dof_count());
    Eigen::VectorXd increment = still;
    static_cast<void>(linearised_.solve(increment, still));  // zero where the linear system has no solution
    missing_ = linearised_.system().gather(increment);
  }
  return verdict;
}

template <class Rule, int Dim>
Eigen::VectorXd QuasiNewtonSession<Rule, Dim>::predict(double from, double to) {
  growth_ = to - from;
  problem_.set_load(to);
  Eigen::VectorXd increment = problem_.constraints().displacement(from, to);
  Eigen::VectorXd before = Eigen::VectorXd::Zero(increment.size());  // where the repeated motion began
  // Beyond ten times the last step the guess would be little else than what was missing then.
  if (motion_.motion_.empty() || !(growth_ > 0.0) || growth_ > 10.0 * motion_.growth_) {
    Eigen::VectorXd const more_load = problem_.loads().at(to) - problem_.loads().at(from);
    static_cast<void>(linearised_.solve(increment, more_load));  // one that fails is no more than a poor first guess
  } else {  // what is missing is made good, and the last motion was too small by as much
    Eigen::Map<Eigen::VectorXd const> const last(motion_.motion_.data(), missing_.size());
    linearised_.system().scatter(growth_ / motion_.growth_ * (last + missing_) + missing_, increment);
    linearised_.system().scatter(-last, before);
  }
  if (problem_.has_field()) problem_.field()->limit(before, increment);
  return increment;
}

template <class Rule, int Dim>
void QuasiNewtonSession<Rule, Dim>::correct(Eigen::VectorXd& increment, StepReport& report, StopCondition const& stop) {
  iterate(increment, report, stop);
  // What led to a rejected step is not repeated; one that was interrupted counts as never made.
  if (report.verdict.acceptable() || report.interrupted()) return;
  motion_.motion_.clear();
  steps_of_provider_ = 0;
}

template <class Rule, int Dim>
void QuasiNewtonSession<Rule, Dim>::iterate(Eigen::VectorXd& increment, StepReport& report, StopCondition const& stop) {
  report.verdict = problem_.plan(increment, &report.worst_point);
  if (!report.verdict.acceptable()) return;
  report.max_displacement_gradient = problem_.max_displacement_gradient();
  mark_ = Clock::now();
  last_gradients_.assign(working_.size(), Gradient<dim>::Zero());
  last_stresses_ = problem_.committed_stresses();
  double linear_residual = 0.0;
  Eigen::VectorXd const no_more = Eigen::VectorXd::Zero(increment.size());
  for (;;) {
    report.history.emplace_back();
    report.history.back().linear_residual = linear_residual;
    report.history.back().material_seconds = report.history.back().seconds = std::exchange(tangent_seconds_, 0.0);
    Evaluation evaluation = recorded(report, increment, false);
    // A point short of its own accuracy gets more work at once: early, while its response may still jump.
    for (int k = 0; k < settings_.max_refinements && report.verdict.status == Status::not_converged; ++k) {
      if (report.stopped(stop)) return;
      learn();  // before the plan changes the response, which would pass for stiffness
      evaluation = recorded(report, increment, true);
    }
    if (report.verdict.status == Status::failed) return;
    learn();
    if (evaluation.residual <= tolerance_ && report.verdict.acceptable()) return;
    if (report.iterations() >= settings_.max_iterations || evaluation.residual > settings_.divergence_limit) {
      if (report.verdict.acceptable()) report.verdict = {Status::not_converged, Reason::iterations_spent};
      return;
    }
    if (report.stopped(stop)) return;
    Eigen::VectorXd next = increment;
    report.verdict = linearised_.linearise(increment, evaluation.unbalanced, working_);
    if (report.verdict.acceptable()) report.verdict = linearised_.solve(next, no_more);
    if (!report.verdict.acceptable()) {
      if (report.verdict.reason == Reason::singular_system) report.weak_dof = linearised_.system().weakest_dof();
      return;
    }
    if (problem_.has_field()) problem_.field()->limit(increment, next);
    linear_residual = linearised_.system().residual();
    increment += next - increment;
  }
}

template <class Rule, int Dim>
void QuasiNewtonSession<Rule, Dim>::accept(Eigen::VectorXd const& increment) {
  problem_.commit(increment);
  learned_ = working_;
  steps_of_provider_ = (steps_of_provider_ + 1) % settings_.tangent_interval;
  if (!repeats_motion_ || !(growth_ > 0.0)) return;
  Eigen::VectorXd const motion = linearised_.system().gather(increment) - missing_;
  motion_ = {{motion.begin(), motion.end()}, growth_};
}

/// Adds the cost to the report.
template <class Rule, int Dim>
Evaluation QuasiNewtonSession<Rule, Dim>::recorded(StepReport& report, Eigen::VectorXd const& increment, bool refine) {
  auto const started = Clock::now();
  Evaluation evaluation = refine ? problem_.refine(increment) : problem_.evaluate(increment);
  auto& record = report.history.back();
  auto const ended = Clock::now();
  record.residual = evaluation.residual;
  record.inner_steps += evaluation.inner_steps;
  record.material_seconds += std::chrono::duration<double>(ended - started).count();
  record.seconds += std::chrono::duration<double>(ended - mark_).count();
  mark_ = ended;
  record.verdict = report.verdict = evaluation.verdict;
  record.worst_point = report.worst_point = evaluation.worst_point;
  record.points = evaluation.points;
  report.parts = evaluation.parts;
  return evaluation;
}

/// The points' tangents; their time belongs to the evaluation that follows.
template <class Rule, int Dim>
std::vector<VoigtTangent<Dim>> QuasiNewtonSession<Rule, Dim>::timed_tangents(bool of_trial_states) {
  auto const started = Clock::now();
  auto tangents = of_trial_states ? problem_.trial_tangents() : problem_.committed_tangents();
  tangent_seconds_ += std::chrono::duration<double>(Clock::now() - started).count();
  return tangents;
}

template <class Rule, int Dim>
void QuasiNewtonSession<Rule, Dim>::learn() {
  with_rule([&]<class RuleType>(RuleType const& rule) {
    if constexpr (FollowsTrialTangent<RuleType, dim>) {
      auto const trial = timed_tangents(true);
      mark_ = Clock::now();
      for (std::size_t k = 0; k < working_.size(); ++k) working_[k] = rule.template at_trial<dim>(trial[k], first_[k]);
    } else {
      learn_from_responses(rule);
    }
  });
}

template <class Rule, int Dim>
template <class RuleType>
void QuasiNewtonSession<Rule, Dim>::learn_from_responses(RuleType const& rule) {
  for (std::size_t k = 0; k < working_.size(); ++k) {
    Gradient<dim> const& gradient = problem_.gradients()[k];
    VoigtStress<dim> const& stress = problem_.responses()[k].stress;
    auto const change = problem_.turns_stresses()
                            ? corotated_secant_pair<dim>(last_gradients_[k], gradient, last_stresses_[k], stress)
                            : SecantPair<dim>{to_engineering_strain<dim, double>(gradient - last_gradients_[k]),
                                              stress - last_stresses_[k]};
    working_[k] = rule.template update<dim>(working_[k], provider_[k], change.strain, change.stress);
    last_gradients_[k] = gradient;
    last_stresses_[k] = stress;
  }
}

#ifdef SCARP_PRECOMPILED
extern template class QuasiNewtonSession<MaterialTangent, 2>;
extern template class QuasiNewtonSession<MaterialTangent, 3>;
#endif

}  // namespace scarp

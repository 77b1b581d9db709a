// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/solver/detail/extrapolated_predictor.hpp"
#include "scarp/solver/incremental_problem.hpp"
#include "scarp/solver/linearised_step.hpp"
#include "scarp/solver/sparse_lu.hpp"
#include "scarp/solver/step_report.hpp"
#include "scarp/solver/tangent_rules.hpp"

namespace scarp {

/// The iteration of a `QuasiNewton` on one problem, which may be an `IncrementalProblem`: factorisation and what the points'
/// tangents have learned. Its members are defined outside so that a library can contain them.
/// \tparam Settings a `QuasiNewton`
/// \tparam Problem an `IncrementalProblem` or `AttachedProblem`
template <class Settings, class Problem>
class SCARP_EXPORT QuasiNewtonSession {
 public:
  static constexpr int dim = Problem::dim;  ///< of the problem

  /// The problem must outlive the session.
  /// \throws InputError for a setting outside of its range
  QuasiNewtonSession(Settings const& settings, Problem& problem)
      : settings_(detail::validated(settings)),
        problem_(problem),
        exact_(problem.have_exact_tangents()),
        tolerance_(settings.tolerance.value_or(exact_ ? 1e-6 : 5e-3)),
        start_(problem, 0.1 * tolerance_) {}

  /// Readies a step from the committed state at a load factor: tangents, factorisation, present imbalance.
  Verdict begin(double load);
  /// Adds the condition and the weak degree of freedom that begin() found.
  void describe(StepReport& report) const { start_.describe(report); }
  /// First guess of the increment [m] between two load factors: the last step's motion where it is known, and what that step left
  /// unbalanced; else a linear solve.
  Eigen::VectorXd predict(double from, double to);

  /// Iterates from a prediction, which ends as the increment in equilibrium; the points' trial states then belong to it.
  void correct(Eigen::VectorXd& increment, StepReport& report, StopCondition const& stop = {});

  /// Commits an increment in equilibrium; the learned tangents start the next step.
  void accept(Eigen::VectorXd const& increment);

  /// State that persists from step to step.
  SCARP_MEMBERS_EXCEPT((settings_, problem_, exact_, tolerance_, start_, mark_, tangent_seconds_, working_,
                        last_gradients_, last_stresses_, missing_, growth_),
                       first_, provider_, steps_of_provider_, learned_, motion_)

 private:
  using Clock = std::chrono::steady_clock;
  using Rule = typename Settings::RuleType;
  using Linear = typename Settings::LinearType;

  void iterate(Eigen::VectorXd& increment, StepReport& report, StopCondition const& stop);
  Evaluation recorded(StepReport& report, Eigen::VectorXd const& increment, bool refine);
  std::vector<VoigtTangent<Problem::dim>> timed_tangents(bool of_trial_states);
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

  Settings settings_;
  Problem& problem_;
  bool exact_;        ///< whether all tangents of materials are derivatives
  double tolerance_;  ///< of the residual
  LinearPredictor<Problem, Linear> start_;
  Clock::time_point mark_{};                       ///< end of the last response of the points in this step
  double tangent_seconds_ = 0.0;                   ///< that no evaluation has counted yet
  std::vector<VoigtTangent<Problem::dim>> first_;  ///< of the state that the session began with
  std::vector<VoigtTangent<Problem::dim>> provider_;
  int steps_of_provider_ = 0;  ///< accepted since these tangents were evaluated
  std::vector<VoigtTangent<Problem::dim>> working_;
  std::vector<VoigtTangent<Problem::dim>> learned_;
  std::vector<Gradient<dim>> last_gradients_;
  std::vector<VoigtStress<dim>> last_stresses_;
  detail::ExtrapolatedPredictor motion_;
  Eigen::VectorXd missing_;  ///< [m] from the committed state to equilibrium; 0 without a motion
  double growth_ = 0.0;      ///< of the load factor in the last prediction
};

template <class Settings, class Problem>
Verdict QuasiNewtonSession<Settings, Problem>::begin(double load) {
  problem_.set_load(load);
  if (steps_of_provider_ == 0) provider_ = timed_tangents(false);
  if (first_.empty()) first_ = provider_;
  if (learned_.empty()) learned_ = provider_;
  working_.resize(provider_.size());
  with_rule([&](auto const& rule) {
    for (std::size_t k = 0; k < working_.size(); ++k) working_[k] = rule.template start<dim>(provider_[k], learned_[k]);
  });
  Verdict const verdict = start_.linearise(working_);
  missing_ = Eigen::VectorXd::Zero(start_.linearised().system().free_count());
  if (verdict.acceptable() && motion_.known()) missing_ = start_.missing();
  return verdict;
}

template <class Settings, class Problem>
Eigen::VectorXd QuasiNewtonSession<Settings, Problem>::predict(double from, double to) {
  growth_ = to - from;
  if (!motion_.known() || !(growth_ > 0.0)) return start_.predict(from, to);
  Eigen::VectorXd increment = start_.prescribed(from, to);
  start_.linearised().system().scatter(motion_.over(growth_, missing_), increment);
  return increment;
}

template <class Settings, class Problem>
void QuasiNewtonSession<Settings, Problem>::correct(Eigen::VectorXd& increment, StepReport& report,
                                                    StopCondition const& stop) {
  iterate(increment, report, stop);
  // What led to a rejected step is not repeated; one that was interrupted counts as never made.
  if (report.verdict.acceptable() || report.interrupted()) return;
  motion_.forget();
  steps_of_provider_ = 0;
}

template <class Settings, class Problem>
void QuasiNewtonSession<Settings, Problem>::iterate(Eigen::VectorXd& increment, StepReport& report,
                                                    StopCondition const& stop) {
  report.verdict = problem_.plan(increment, &report.worst_point);
  if (!report.verdict.acceptable()) return;
  report.max_displacement_gradient = problem_.max_displacement_gradient();
  mark_ = Clock::now();
  last_gradients_.assign(working_.size(), Gradient<dim>::Zero());
  last_stresses_ = problem_.committed_stresses();
  auto& linearised = start_.linearised();
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
    report.verdict = linearised.linearise(increment, evaluation.unbalanced, working_);
    if (report.verdict.acceptable()) report.verdict = linearised.solve(next, no_more);
    if (!report.verdict.acceptable()) {
      if (report.verdict.reason == Reason::singular_system) report.weak_dof = linearised.weak_dof();
      return;
    }
    linear_residual = linearised.linear_residual();
    Eigen::VectorXd const correction = next - increment;
    increment += correction;
  }
}

template <class Settings, class Problem>
void QuasiNewtonSession<Settings, Problem>::accept(Eigen::VectorXd const& increment) {
  problem_.commit(increment);
  learned_ = working_;
  steps_of_provider_ = (steps_of_provider_ + 1) % settings_.tangent_interval;
  if (settings_.repeats_motion && growth_ > 0.0)
    motion_.remember(start_.linearised().system().gather(increment) - missing_, growth_);
}

/// Evaluates all points and adds the cost to the report.
template <class Settings, class Problem>
Evaluation QuasiNewtonSession<Settings, Problem>::recorded(StepReport& report, Eigen::VectorXd const& increment,
                                                           bool refine) {
  auto const started = Clock::now();
  Evaluation evaluation = refine ? problem_.refine(increment) : problem_.evaluate(increment);
  auto& record = report.history.back();
  auto const ended = Clock::now();
  record.residual = evaluation.residual;
  record.inner_steps += evaluation.inner_steps;
  record.material_seconds += std::chrono::duration<double>(ended - started).count();
  record.seconds += std::chrono::duration<double>(ended - mark_).count();
  mark_ = ended;
  record.verdict = evaluation.verdict;
  record.worst_point = evaluation.worst_point;
  record.points = evaluation.points;
  report.verdict = evaluation.verdict;
  report.worst_point = evaluation.worst_point;
  report.parts = evaluation.parts;
  return evaluation;
}

/// The points' tangents; their time belongs to the evaluation that follows.
template <class Settings, class Problem>
std::vector<VoigtTangent<Problem::dim>> QuasiNewtonSession<Settings, Problem>::timed_tangents(bool of_trial_states) {
  auto const started = Clock::now();
  auto tangents = of_trial_states ? problem_.trial_tangents() : problem_.committed_tangents();
  tangent_seconds_ += std::chrono::duration<double>(Clock::now() - started).count();
  return tangents;
}

template <class Settings, class Problem>
void QuasiNewtonSession<Settings, Problem>::learn() {
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

template <class Settings, class Problem>
template <class RuleType>
void QuasiNewtonSession<Settings, Problem>::learn_from_responses(RuleType const& rule) {
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

/// Newton-type iteration for one load step: the tangent rule gives the points' tangents in each iteration. Every iteration
/// moves the points along the straight path from their committed states to the iterate.
template <class Rule = MaterialTangent, LinearSolver Linear = SparseLu>
  requires TangentRule<Rule, 2> || ChoosesTangentRule<Rule, 2>
struct QuasiNewton {
  /// Force residual, see EquilibriumProblem::residuals; without one 1e-6 where all materials have exact tangents, else 5e-3.
  std::optional<double> tolerance{};
  int max_iterations = 30;         ///< of a load step; then it is given up
  double divergence_limit = 10.0;  ///< residual beyond which a step is given up
  int max_refinements = 8;         ///< of points that have not converged, in each iteration
  /// A step's first guess is the motion of the step before, scaled by the load, and the correction of what that one left
  /// unbalanced; after a rejected one it is linear.
  bool repeats_motion = true;
  int tangent_interval = 4;  ///< load steps that share one evaluation of the provider's tangents
  Rule rule{};               ///< working tangent of each point

  /// \throws InputError for a setting outside of its range
  void validate() const {
    if (tolerance) require_positive("tolerance of the force residual", *tolerance);
    require_at_least("most iterations of a load step", max_iterations, 1);
    require_at_least("residual beyond which a step is given up", divergence_limit, tolerance.value_or(5e-3));
    require_at_least("most refinements of an iteration", max_refinements, 0);
    require_at_least("load steps that share the provider's tangents", tangent_interval, 1);
    detail::validated(rule);
  }

  using RuleType = Rule;      ///< for sessions
  using LinearType = Linear;  ///< for sessions

  /// The iteration on one problem, seen as an `IncrementalProblem`.
  template <class Problem>
  using Session = QuasiNewtonSession<QuasiNewton, typename Problem::Interface>;
};

#ifdef SCARP_PRECOMPILED
/// DECLARE: `extern template`, or `template` in the library.
#define SCARP_SESSIONS(DECLARE)                                           \
  DECLARE class QuasiNewtonSession<QuasiNewton<>, IncrementalProblem<2>>; \
  DECLARE class QuasiNewtonSession<QuasiNewton<>, AttachedProblem<2>>;    \
  DECLARE class QuasiNewtonSession<QuasiNewton<>, IncrementalProblem<3>>;
SCARP_SESSIONS(extern template)
#endif

}  // namespace scarp

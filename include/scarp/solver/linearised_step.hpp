// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "scarp/solver/detail/standing_balance.hpp"
#include "scarp/solver/free_system.hpp"
#include "scarp/solver/problem.hpp"
#include "scarp/solver/step_report.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// The displacement at which a linearised ground and what is attached to it balance the loads. The attachment has its own
/// forces: contact that opens, closes or slides is followed here, where no material point is evaluated. Without attachment
/// this is one linear solve.
template <int Dim, LinearSolver Linear>
class LinearisedStep {
  using Problem = scarp::Problem<Dim>;

 public:
  static constexpr double singular = 1e15;  ///< condition beyond which no digit of a solution is left
  static constexpr double stagnated = 0.1;  ///< linear residual of an iteration that found no solution

  /// accuracy: residual below which the attachment's forces need no further correction
  LinearisedStep(Problem& problem, double accuracy)
      : problem_(problem), system_(problem.constraints()), accuracy_(accuracy) {
    if (problem.has_attachment()) beside_.emplace(problem);
  }
  LinearisedStep(LinearisedStep const&) = delete;  // the equations refer to the system
  LinearisedStep& operator=(LinearisedStep const&) = delete;

  /// Linearises about the increment [m] of the problem's last evaluation, whose unbalanced forces [N] are given.
  Verdict linearise(Eigen::VectorXd const& increment, Eigen::VectorXd const& unbalanced,
                    std::vector<VoigtTangent<Dim>> const& tangents) {
    problem_.ground_stiffness(increment, tangents, ground_);
    centre_ = increment;
    ground_forces_ = unbalanced;
    if (beside_) ground_forces_ -= problem_.attached_forces(increment);
    Verdict const verdict = factorize();
    is_held_ = verdict.acceptable();
    // A body that floats above its ground, as before its weight comes, is no fault yet: `solve` lets it down.
    if (beside_ && verdict.reason == Reason::singular_system && !beside_->is_held()) return {};
    return verdict;
  }

  /// About the committed state, at the load factor that the problem is aimed at.
  /// \return singular_system also where no digit of a solution is left
  Verdict linearise_committed(std::vector<VoigtTangent<Dim>> const& tangents) {
    Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem_.dof_count());
    Verdict verdict = linearise(still, problem_.evaluate_committed().unbalanced, tangents);
    committed_condition_ = verdict.acceptable() ? condition() : 0.0;
    if (committed_condition_ > singular) verdict = {Status::failed, Reason::singular_system};
    committed_weak_dof_ = verdict.reason == Reason::singular_system ? weak_dof() : -1;
    return verdict;
  }
  /// Adds what was found out about the committed state.
  void describe(StepReport& report) const {
    report.condition = committed_condition_;
    report.weak_dof = committed_weak_dof_;
  }

  /// Moves an increment [m], kept at its prescribed entries, to where forces balance when the loads have grown by `more` [N]
  /// since the linearisation. What cannot be balanced is left to the next linearisation.
  Verdict solve(Eigen::VectorXd& increment, Eigen::VectorXd const& more) {
    return beside_ ? follow_contact(increment, more) : correct(increment, ground_imbalance(increment, more));
  }

  FreeSystem const& system() const { return system_; }  ///< Numbering of the free degrees of freedom.
  /// Estimate for the last matrix, in the 1-norm; 0 where a body floats.
  double condition() const { return is_held_ ? equations_.condition() : 0.0; }
  /// |K x - b| / |b| of the last linear system.
  double linear_residual() const { return linear_residual_; }
  /// Degree of freedom that the last matrix holds least.
  int weak_dof() const { return system_.dof(equations_.weakest()); }

 private:
  static constexpr int max_iterations = 40;
  static constexpr int max_fruitless = 4;          ///< iterations in a row without a better balance
  static constexpr double min_share = 0.1;         ///< of Newton's correction
  static constexpr double longest_share = 1024.0;  ///< of one with all contacts held

  struct Balance {
    Eigen::VectorXd increment;
    Eigen::VectorXd unbalanced;
    double residual = 0.0;
    double beside = 0.0;  ///< residual of an attached body; 1 when nothing carries it

    /// A body that has lost its contacts finds no way back by derivatives.
    bool lost() const { return !(beside < 1.0); }
    bool improves(Balance const& other) const {
      return residual < other.residual && (!lost() || beside < other.beside);
    }
  };

  /// A straight way through increments, and the ground's forces along it.
  struct Way {
    Eigen::VectorXd start;
    Eigen::VectorXd direction;
    Eigen::VectorXd ground_at_start;
    Eigen::VectorXd ground_along;
  };

  Verdict factorize() { return beside_ ? factorize(ground_ + problem_.attached_stiffness()) : factorize(ground_); }

  /// Without free degrees of freedom, as in a test of a law on one element, there are no equations.
  Verdict factorize(GroundStiffness const& all) {
    return system_.free_count() == 0 ? Verdict{} : equations_.factorize(system_, all);
  }

  Eigen::VectorXd ground_imbalance(Eigen::VectorXd const& increment, Eigen::VectorXd const& more) const {
    return ground_forces_ + ground_ * (increment - centre_) - more;
  }

  /// One linear solve.
  Verdict correct(Eigen::VectorXd& increment, Eigen::VectorXd const& unbalanced) {
    if (system_.free_count() == 0) return {};
    Eigen::VectorXd const force = -system_.gather(unbalanced);
    Eigen::VectorXd const correction = equations_.solve(force);
    double const norm = force.norm();
    linear_residual_ = norm > 0.0 ? (equations_.product(correction) - force).norm() / norm : 0.0;
    if (!(linear_residual_ < 1.0)) return {Status::failed, Reason::singular_system};
    if (ground_.around && linear_residual_ > stagnated) return {Status::not_converged, Reason::iterations_spent};
    system_.scatter(system_.gather(increment) + correction, increment);
    return {};
  }

  /// Newton's method; attached bodies are balanced at every place that is tried. Where Newton's direction
  /// leads to no smaller imbalance, that of held contacts is followed as far as the unbalanced forces do work.
  Verdict follow_contact(Eigen::VectorXd& increment, Eigen::VectorXd const& more) {
    Eigen::VectorXd const still = Eigen::VectorXd::Zero(increment.size());
    beside_->begin();
    Balance now = balance({increment, still, ground_imbalance(increment, more), still}, 0.0);
    double const goal = std::max(accuracy_, 1e-3 * now.residual);
    Balance best = now;
    int fruitless = 0;
    for (int iteration = 0; iteration < max_iterations; ++iteration) {
      // Once in any case: a small residual may be that of boundary nodes which have moved alone.
      if (iteration > 0 && (now.residual <= goal || beside_->spent())) break;
      Way way;
      Balance next;
      bool const downhill = factorize().acceptable() && lay(way, now, more).acceptable() && go_downhill(way, now, next);
      if (!downhill) {  // also where the matrix is singular, since nothing but sliding points holds a body
        Verdict verdict = factorize(ground_ + problem_.stick_stiffness());
        if (verdict.acceptable()) verdict = lay(way, now, more);
        if (!verdict.acceptable()) return verdict;
        if (!go_by_work(way, next)) break;
      }
      now = std::move(next);
      fruitless = now.residual < best.residual ? 0 : fruitless + 1;
      if (fruitless == 0) best = now;
      if (fruitless == max_fruitless) break;
    }
    increment = best.increment;
    problem_.attached_forces(increment);
    return {};
  }

  /// A way from a balance along the correction of the last matrix.
  Verdict lay(Way& way, Balance const& from, Eigen::VectorXd const& more) {
    Eigen::VectorXd whole = from.increment;
    if (Verdict const verdict = correct(whole, from.unbalanced); !verdict.acceptable()) return verdict;
    way = {from.increment, whole - from.increment, ground_imbalance(from.increment, more), {}};
    way.ground_along = ground_ * way.direction;
    return {};
  }

  /// Halves the way until the balance improves, or doubles it as long as it does.
  bool go_downhill(Way const& way, Balance const& now, Balance& best) {
    double share = 1.0;
    best = balance(way, share);
    while (!best.improves(now) && share > min_share) best = balance(way, share *= 0.5);
    if (!best.improves(now)) {
      problem_.attached_forces(now.increment);
      return false;
    }
    if (share == 1.0) {
      for (Balance further = balance(way, 2.0); further.improves(best); further = balance(way, 2.0 * share)) {
        best = std::move(further);
        share *= 2.0;
      }
    }
    problem_.attached_forces(best.increment);
    return true;
  }

  bool go_by_work(Way const& way, Balance& next) {
    Eigen::VectorXd const free = system_.gather(way.direction);
    auto const work = [&](double share) { return system_.gather(balance(way, share).unbalanced).dot(free); };
    auto const share = detail::zero_power_step(work, longest_share);
    if (!share) return false;
    next = balance(way, *share);
    return true;
  }

  /// The attachment's trial state then belongs to the increment.
  Balance balance(Way const& way, double share) {
    Balance now;
    now.increment = way.start + share * way.direction;
    Eigen::VectorXd const of_ground = way.ground_at_start + share * way.ground_along;
    beside_->settle(now.increment, -of_ground, 0.1 * accuracy_);
    now.unbalanced = of_ground + problem_.attached_forces(now.increment);
    now.residual = problem_.residual(now.unbalanced);
    now.beside = problem_.residual_beside(now.unbalanced);
    return now;
  }

  Problem& problem_;
  FreeSystem system_;
  double accuracy_;
  std::optional<detail::StandingBalance<Dim>> beside_;  ///< where something is attached
  GroundStiffness ground_;
  detail::GroundEquations<Linear> equations_;  ///< with what is attached
  Eigen::VectorXd centre_;
  Eigen::VectorXd ground_forces_;  ///< internal forces of the elements less the loads, at the centre
  double linear_residual_ = 0.0;
  double committed_condition_ = 0.0;
  int committed_weak_dof_ = -1;
  bool is_held_ = false;  ///< all bodies, when the system was linearised
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <vector>

#include "scarp/core/voigt.hpp"
#include "scarp/solver/detail/ground_equations.hpp"

namespace scarp {

/// The displacement at which a linearised ground and what is attached to it balance the loads. The attachment keeps its own
/// forces: contact that opens, closes or slides is followed here, by Newton's method with backtracking, where no material
/// point is asked. Without attachment this is one linear solve.
template <class Problem, LinearSolver Linear>
class LinearisedStep {
 public:
  static constexpr double singular = 1e15;  ///< condition beyond which no digit of a solution is left

  /// accuracy: residual below which the attachment's forces need no further correction
  LinearisedStep(Problem& problem, double accuracy)
      : problem_(problem), system_(problem.constraints()), accuracy_(accuracy) {}

  /// Linearises about the increment [m] of the problem's last evaluation, whose unbalanced forces [N] are given.
  Verdict linearise(Eigen::VectorXd const& increment, Eigen::VectorXd const& unbalanced,
                    std::vector<VoigtTangent<Problem::dim>> const& tangents) {
    problem_.ground_stiffness(increment, tangents, ground_);
    centre_ = increment;
    ground_forces_ = unbalanced;
    if constexpr (!Problem::is_bare) ground_forces_ -= problem_.attached_forces(increment);
    return factorize();
  }

  /// Moves an increment [m], kept at its prescribed entries, to where forces balance when the loads have grown by `more` [N]
  /// since the linearisation. What cannot be balanced is left to the next linearisation.
  Verdict solve(Eigen::VectorXd& increment, Eigen::VectorXd const& more) {
    if constexpr (Problem::is_bare) {
      return correct(increment, ground_imbalance(increment, more));
    } else {
      return follow_contact(increment, more);
    }
  }

  FreeSystem const& system() const { return system_; }
  /// Estimate for the last matrix, in the 1-norm.
  double condition() const { return equations_.condition(); }
  /// |K x - b| / |b| of the last linear system.
  double linear_residual() const { return linear_residual_; }
  /// Degree of freedom that the last matrix holds least.
  int weak_dof() const { return system_.dof(equations_.weakest()); }

 private:
  static constexpr int most_iterations = 20;
  static constexpr double least_share = 0.1;        ///< of Newton's correction
  static constexpr double least_held_share = 1e-4;  ///< of one with all contacts held

  using Stiffness = typename Problem::GroundStiffness;

  struct Balance {
    Eigen::VectorXd unbalanced;
    double residual = 0.0;
    double beside = 0.0;  ///< residual of a body beside the mesh; 1 when nothing carries it

    /// A body that has lost its contacts finds no way back by derivatives.
    bool lost() const { return !(beside < 1.0); }
    bool improves(Balance const& other) const {
      return residual < other.residual && (!lost() || beside < other.beside);
    }
  };

  Verdict factorize() {
    if constexpr (Problem::is_bare) {
      return factorize(ground_);
    } else {
      return factorize(ground_ + problem_.attached_stiffness());
    }
  }

  Verdict factorize(Stiffness const& all) { return equations_.factorize(system_, all); }

  Eigen::VectorXd ground_imbalance(Eigen::VectorXd const& increment, Eigen::VectorXd const& more) const {
    return ground_forces_ + ground_ * (increment - centre_) - more;
  }

  /// One linear solve.
  Verdict correct(Eigen::VectorXd& increment, Eigen::VectorXd const& unbalanced) {
    Eigen::VectorXd const force = -system_.gather(unbalanced);
    Eigen::VectorXd const correction = equations_.solve(force);
    double const norm = force.norm();
    linear_residual_ = norm > 0.0 ? (equations_.product(correction) - force).norm() / norm : 0.0;
    if (!(linear_residual_ < 1.0)) return {Status::failed, Reason::singular_system};
    system_.scatter(system_.gather(increment) + correction, increment);
    return {};
  }

  /// Newton's method with backtracking. Where all points slide, its direction may be none: then the direction of held
  /// contacts is followed as far as it helps.
  Verdict follow_contact(Eigen::VectorXd& increment, Eigen::VectorXd const& more) {
    Balance now = balance(increment, more);
    double const goal = std::max(accuracy_, 1e-3 * now.residual);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      Eigen::VectorXd const start = increment;
      Eigen::VectorXd whole = start;
      if (Verdict const verdict = correct(whole, now.unbalanced); !verdict.acceptable()) return verdict;
      Balance next = now;
      if (!go(start, whole - start, least_share, more, increment, next)) {
        Eigen::VectorXd held = start;
        Verdict verdict = factorize(ground_ + problem_.held_stiffness());
        if (verdict.acceptable()) verdict = correct(held, now.unbalanced);
        if (!verdict.acceptable() || !go(start, held - start, least_held_share, more, increment, next)) {
          Balance const plain = balance(whole, more);
          if (iteration == 0 && !plain.lost()) increment = whole;
          return {};
        }
      }
      if (next.residual <= goal) return {};
      now = std::move(next);
      if (Verdict const verdict = factorize(); !verdict.acceptable()) return verdict;
    }
    return {};
  }

  /// Along a direction from a start: halves until the balance improves, or doubles as long as it does.
  /// \return whether it improved; if not, the increment is the start
  bool go(Eigen::VectorXd const& start, Eigen::VectorXd const& direction, double least, Eigen::VectorXd const& more,
          Eigen::VectorXd& increment, Balance& best) {
    Balance const first = best;
    double share = 1.0;
    auto const at = [&](double part) { return balance(start + part * direction, more); };
    best = at(share);
    while (!best.improves(first) && share > least) best = at(share *= 0.5);
    if (!best.improves(first)) {
      increment = start;
      best = at(0.0);
      return false;
    }
    if (share == 1.0) {
      for (Balance further = at(2.0); further.improves(best); further = at(2.0 * share)) {
        best = std::move(further);
        share *= 2.0;
      }
      best = at(share);
    }
    increment = start + share * direction;
    return true;
  }

  /// The attachment's trial state then belongs to the increment.
  Balance balance(Eigen::VectorXd const& increment, Eigen::VectorXd const& more) {
    Balance now{ground_imbalance(increment, more) + problem_.attached_forces(increment)};
    now.residual = problem_.residual(now.unbalanced);
    now.beside = problem_.residual_beside(now.unbalanced);
    return now;
  }

  Problem& problem_;
  FreeSystem system_;
  double accuracy_;
  Stiffness ground_;
  detail::GroundEquations<Stiffness, Linear> equations_;  ///< with what is attached
  Eigen::VectorXd centre_;
  Eigen::VectorXd ground_forces_;  ///< internal forces of the elements less the loads, at the centre
  double linear_residual_ = 0.0;
};

}  // namespace scarp

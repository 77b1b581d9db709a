// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "scarp/core/precompiled.hpp"
#include "scarp/solver/detail/body_following.hpp"
#include "scarp/solver/detail/standing_balance.hpp"
#include "scarp/solver/linear_system.hpp"
#include "scarp/solver/problem.hpp"

namespace scarp::detail {

/// Balances a linearised ground with what is attached to it: contact that opens, closes or slides is followed where no
/// material point is evaluated.
template <int Dim>
class SCARP_EXPORT ContactFollowing final : public BodyFollowing {
 public:
  /// accuracy: residual below which the attachment's forces need no further correction
  ContactFollowing(Problem<Dim>& problem, LinearSystem& system, double accuracy)
      : problem_(problem), system_(system), accuracy_(accuracy), body_(problem) {}

  bool is_held() const override { return body_.is_held(); }
  Verdict factorize(LinearisedGround const& ground) override {
    return factorize(ground, problem_.attached_stiffness());
  }

  /// Newton's method; attached bodies are balanced at every place that is tried. Where Newton's direction
  /// leads to no smaller imbalance, that of held contacts is followed as far as the unbalanced forces do work.
  Verdict follow(LinearisedGround const& ground, Eigen::VectorXd& increment, Eigen::VectorXd const& more) override {
    Eigen::VectorXd const still = Eigen::VectorXd::Zero(increment.size());
    body_.begin();
    Tried now = balance({increment, still, ground.unbalanced(increment, more), still}, 0.0);
    double const goal = std::max(accuracy_, 1e-3 * now.residual);
    Tried best = now;
    int fruitless = 0;
    for (int iteration = 0; iteration < max_iterations; ++iteration) {
      // Once in any case: a small residual may be that of boundary nodes which have moved alone.
      if (iteration > 0 && (now.residual <= goal || body_.spent())) break;
      Way way;
      Tried next;
      // A field's equations are linear here. Once they balance, they do so along every way: so the first one goes
      // whole.
      bool const whole = iteration == 0 && problem_.has_field();
      bool const downhill = factorize(ground).acceptable() && lay(way, ground, now, more).acceptable() &&
                            (whole ? go_whole(way, goal, now, next) : go_downhill(way, now, next));
      if (!downhill) {  // also where the matrix is singular, since nothing but sliding points holds a body
        Verdict verdict = factorize(ground, problem_.stick_stiffness());
        // A body without weight that the ground moves away from stays where it is.
        if (verdict.reason == Reason::singular_system && body_.is_idle(now.unbalanced))
          verdict = factorize(ground, problem_.stick_stiffness() + body_.in_place());
        if (verdict.acceptable()) verdict = lay(way, ground, now, more);
        if (!verdict.acceptable()) return verdict;
        if (whole) {
          next = balance(way, 1.0);
        } else if (!go_by_work(way, next)) {
          break;
        }
      }
      now = std::move(next);
      fruitless = whole || now.residual < best.residual ? 0 : fruitless + 1;
      if (fruitless == 0) best = now;
      if (fruitless == max_fruitless) break;
    }
    increment = best.increment;
    problem_.attached_forces(increment);
    return {};
  }

 private:
  static constexpr int max_iterations = 40;
  static constexpr int max_fruitless = 4;          ///< iterations in a row without a better balance
  static constexpr double min_share = 0.1;         ///< of Newton's correction
  static constexpr double longest_share = 1024.0;  ///< of one with all contacts held

  struct Tried {
    Eigen::VectorXd increment;
    Eigen::VectorXd unbalanced;
    double residual = 0.0;
    double beside = 0.0;  ///< residual of an attached body; 1 when nothing carries it

    /// A body that has lost its contacts finds no way back by derivatives.
    bool lost() const { return !(beside < 1.0); }
    bool improves(Tried const& other) const { return residual < other.residual && (!lost() || beside < other.beside); }
  };

  /// A straight way through increments, and the ground's forces along it.
  struct Way {
    Eigen::VectorXd start;
    Eigen::VectorXd direction;
    Eigen::VectorXd ground_at_start;
    Eigen::VectorXd ground_along;
  };

  Verdict factorize(LinearisedGround const& ground, SparseMatrix const& attached) {
    auto const& [own, around, iterate] = ground.stiffness;
    return system_.factorize({own + attached, around, iterate});
  }

  /// A way from a balance along the correction of the last matrix.
  Verdict lay(Way& way, LinearisedGround const& ground, Tried const& from, Eigen::VectorXd const& more) {
    Eigen::VectorXd whole = from.increment;
    if (Verdict const verdict = system_.correct(whole, from.unbalanced); !verdict.acceptable()) return verdict;
    way = {from.increment, whole - from.increment, ground.unbalanced(from.increment, more), {}};
    way.ground_along = ground.stiffness * way.direction;
    return {};
  }

  /// \return whether the balance at the end of the way is no worse, or good enough
  bool go_whole(Way const& way, double goal, Tried const& now, Tried& next) {
    next = balance(way, 1.0);
    return !next.lost() && next.residual <= std::max(goal, now.residual);
  }

  /// Halves the way until the balance improves, or doubles it as long as it does.
  bool go_downhill(Way const& way, Tried const& now, Tried& best) {
    double share = 1.0;
    best = balance(way, share);
    while (!best.improves(now) && share > min_share) best = balance(way, share *= 0.5);
    if (!best.improves(now)) {
      problem_.attached_forces(now.increment);
      return false;
    }
    if (share == 1.0) {
      for (Tried further = balance(way, 2.0); further.improves(best); further = balance(way, 2.0 * share)) {
        best = std::move(further);
        share *= 2.0;
      }
    }
    problem_.attached_forces(best.increment);
    return true;
  }

  bool go_by_work(Way const& way, Tried& next) {
    Eigen::VectorXd const free = system_.gather(way.direction);
    auto const work = [&](double share) { return system_.gather(balance(way, share).unbalanced).dot(free); };
    auto const share = zero_power_step(work, longest_share);
    if (!share) return false;
    next = balance(way, *share);
    return true;
  }

  /// The attachment's trial state then belongs to the increment.
  Tried balance(Way const& way, double share) {
    Tried now;
    now.increment = way.start + share * way.direction;
    Eigen::VectorXd const of_ground = way.ground_at_start + share * way.ground_along;
    body_.solve(now.increment, -of_ground, 0.1 * accuracy_);
    now.unbalanced = of_ground + problem_.attached_forces(now.increment);
    now.residual = problem_.force_residual(now.unbalanced);
    now.beside = problem_.residual_beside(now.unbalanced);
    return now;
  }

  Problem<Dim>& problem_;
  LinearSystem& system_;
  double accuracy_;
  StandingBalance<Dim> body_;
};

template <int Dim>
std::unique_ptr<BodyFollowing> follow_contact(Problem<Dim>& problem, LinearSystem& system, double accuracy) {
  return std::make_unique<ContactFollowing<Dim>>(problem, system, accuracy);
}

#ifdef SCARP_PRECOMPILED
extern template class ContactFollowing<2>;
extern template class ContactFollowing<3>;
#endif

}  // namespace scarp::detail

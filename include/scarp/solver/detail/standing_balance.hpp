// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "scarp/solver/problem.hpp"

namespace scarp::detail {

/// Where unbalanced forces cease to do work along a straight way: of bodies with a potential the place of the least
/// one. The forces of stiffness and friction oppose motion ever more the farther it goes, so that there is one such
/// place, also where the size of the imbalance is flat and shows no way.
/// work(share): unbalanced (internal less external) forces times the way, at a share of it; negative at share 0,
/// continuous
/// \param most largest share that is tried
/// \return share at which less than a thousandth of the work at 0 is left, nothing if there is none up to `most`
template <class Work>
std::optional<double> zero_power_step(Work const& work, double most) {
  constexpr double left = 1e-3;
  constexpr int max_evaluations = 40;
  constexpr double min_bracket = 1e-10;  // of the share
  double const whole = work(0.0);
  if (!(whole < 0.0)) return std::nullopt;
  double below = 0.0;
  double above = 1.0;
  double before = whole;
  double after = work(above);
  while (after < 0.0) {
    if (-after <= -left * whole) return above;
    if (above >= most) return std::nullopt;
    below = above;
    before = after;
    above *= 2.0;
    after = work(above);
  }
  double share = above;
  double now = after;
  for (int k = 0; k < max_evaluations && std::abs(now) > -left * whole && above - below > min_bracket * above; ++k) {
    // The secant of the bracket, and now and then its middle, since the work bends sharply where points stick or open.
    share = k % 3 == 2 ? (below + above) / 2.0 : below + (above - below) * before / (before - after);
    now = work(share);
    (now < 0.0 ? below : above) = share;
    (now < 0.0 ? before : after) = now;
  }
  return share;
}

/// Balances attached bodies, on its own few degrees of freedom, wherever the nodes of the mesh are: a rigid body
/// on contacts. So a ground never sees the forces of a body that is out of balance.
///
/// Newton's method with halving as long as it makes the imbalance smaller. A body all of whose points slide has no
/// stiffness along its base, and there its imbalance is flat: then the stiffness of held contacts, which is positive,
/// gives a direction along which the unbalanced forces do work, and the body goes as far as they do (the least
/// potential along a line; friction and unilateral springs have one as long as the pressures stay).
template <int Dim>
class StandingBalance {
  using Problem = scarp::Problem<Dim>;

 public:
  explicit StandingBalance(Problem& problem) : problem_(problem), length_(problem.length()), own_(problem.free_dofs()) {
    std::erase_if(own_, [&](int dof) { return dof < problem.first_beside(); });
  }

  /// Whether the contacts of the last evaluation support the body in every direction.
  bool is_held() const { return own_.empty() || factors(problem_.attached_stiffness()).isInvertible(); }

  /// Whether no force acts on attached bodies. unbalanced [N]: on all degrees of freedom
  bool is_idle(Eigen::VectorXd const& unbalanced) const { return !own_.empty() && unbalanced(own_).isZero(0.0); }
  /// A stiffness [N/m] that holds them where they are, of any size, since no force acts.
  SparseMatrix in_place() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (int const dof : own_) entries.emplace_back(dof, dof, 1.0);
    SparseMatrix stiffness(problem_.dof_count(), problem_.dof_count());
    stiffness.setFromTriplets(entries.begin(), entries.end());
    return stiffness;
  }

  /// Begins the count of evaluations of the attachment, which are limited: a body that slides without friction, or on
  /// springs so stiff that round-off hides its imbalance, could be evaluated without end.
  void begin() { evaluations_ = 0; }
  bool spent() const { return evaluations_ >= max_evaluations; }

  /// Moves the entries of attached bodies in an increment [m]; loads [N]: on all degrees of freedom.
  /// The attachment's trial state then belongs to the increment.
  /// \return whether they balance, to `accuracy` of the loads of attached bodies
  bool solve(Eigen::VectorXd& increment, Eigen::VectorXd const& loads, double accuracy) {
    if (own_.empty()) return true;
    loads_ = loads(own_);
    double const enough = accuracy * loads_.norm();
    Eigen::VectorXd place = increment(own_);
    Eigen::VectorXd unbalanced = at(place, increment);
    for (int iteration = 0; iteration < max_iterations && !spent(); ++iteration) {
      if (unbalanced.norm() <= better * enough) break;
      if (by_newton(place, unbalanced, increment)) continue;
      if (unbalanced.norm() <= enough || !by_work(place, unbalanced, increment)) break;
    }
    return unbalanced.norm() <= enough;
  }

 private:
  static constexpr int max_iterations = 100;
  static constexpr int max_evaluations = 3000;
  static constexpr double better = 1e-3;  ///< of the required accuracy, where Newton's method comes that far
  static constexpr double min_share = 0.1;
  static constexpr double decrease = 0.1;  ///< of the imbalance, over the share of Newton's step
  // Over the length of the body:
  static constexpr double first_way = 1e-5;  ///< of a body that touches nothing
  static constexpr double longest_way = 1.0;
  static constexpr double min_way = 1e-15;  ///< round-off of places some ten lengths from the origin

  bool by_newton(Eigen::VectorXd& place, Eigen::VectorXd& unbalanced, Eigen::VectorXd& increment) {
    auto const tangent = factors(problem_.attached_stiffness());
    if (!tangent.isInvertible()) return false;
    Eigen::VectorXd const direction = -tangent.solve(unbalanced);
    if (direction.norm() < min_way * length_) return false;
    for (double share = 1.0; share > min_share; share *= 0.5) {
      Eigen::VectorXd const there = place + share * direction;
      Eigen::VectorXd const left = at(there, increment);
      if (!(left.norm() < (1.0 - decrease * share) * unbalanced.norm())) continue;
      place = there;
      unbalanced = left;
      return true;
    }
    at(place, increment);
    return false;
  }

  bool by_work(Eigen::VectorXd& place, Eigen::VectorXd& unbalanced, Eigen::VectorXd& increment) {
    auto const held = factors(problem_.stick_stiffness());
    Eigen::VectorXd const direction = held.isInvertible()
                                          ? Eigen::VectorXd(-held.solve(unbalanced))
                                          : Eigen::VectorXd(-first_way * length_ / unbalanced.norm() * unbalanced);
    if (direction.norm() < min_way * length_) return false;
    double const start = unbalanced.dot(direction);
    auto const work = [&](double share) {
      return share == 0.0 ? start : at(place + share * direction, increment).dot(direction);
    };
    auto const share = zero_power_step(work, std::max(1.0, longest_way * length_ / direction.norm()));
    if (share) place += *share * direction;
    unbalanced = at(place, increment);
    return share.has_value();
  }

  /// Unbalanced forces [N] with the body at a place.
  Eigen::VectorXd at(Eigen::VectorXd const& place, Eigen::VectorXd& increment) {
    ++evaluations_;
    increment(own_) = place;
    return problem_.attached_forces(increment)(own_) - loads_;
  }

  /// Factors of that part of a stiffness that belongs to attached bodies.
  Eigen::FullPivLU<Eigen::MatrixXd> factors(SparseMatrix const& all) const {
    Eigen::MatrixXd part(own_.size(), own_.size());
    for (int column = 0; column < count(own_); ++column)
      for (int row = 0; row < count(own_); ++row) part(row, column) = all.coeff(own_[index(row)], own_[index(column)]);
    return Eigen::FullPivLU<Eigen::MatrixXd>(part);
  }

  Problem& problem_;
  double length_;         ///< of the body [m]
  std::vector<int> own_;  ///< free degrees of freedom of attached bodies
  Eigen::VectorXd loads_;
  int evaluations_ = 0;
};

}  // namespace scarp::detail

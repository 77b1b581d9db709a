// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <algorithm>
#include <vector>

#include "scarp/solver/detail/work_search.hpp"

namespace scarp::detail {

/// Balances what stands beside a mesh, on its own few degrees of freedom, wherever the nodes of the mesh are: a rigid body
/// on contacts. So a ground never sees the forces of a body that is out of balance.
///
/// Newton's method with halving as long as it makes the imbalance smaller. A body all of whose points slide has no
/// stiffness along its base, and there its imbalance is flat: then the stiffness of held contacts, which is positive,
/// gives a direction along which the unbalanced forces do work, and the body goes as far as they do (the least potential
/// along a line; friction and unilateral springs have one as long as the pressures stay).
template <class Problem>
class StandingBalance {
 public:
  explicit StandingBalance(Problem& problem) : problem_(problem) {
    for (int const dof : problem.constraints().free_dofs()) {
      if (dof >= problem.first_beside()) dofs_.push_back(dof);
    }
  }

  /// Whether the contacts of the last question hold it in every direction.
  bool is_held() const { return dofs_.empty() || factors(problem_.attached_stiffness()).isInvertible(); }

  /// Begins the count of questions to the attachment, which are limited: a body that slides without friction, or on springs so
  /// stiff that round-off hides its imbalance, could be asked without end.
  void begin() { asked_ = 0; }
  bool spent() const { return asked_ >= most_questions; }

  /// Moves the entries beside the mesh of an increment [m]; loads [N]: on all degrees of freedom.
  /// The attachment's trial state then belongs to the increment.
  /// \return whether they balance, to `accuracy` of the loads beside the mesh
  bool settle(Eigen::VectorXd& increment, Eigen::VectorXd const& loads, double accuracy) {
    if (dofs_.empty()) return true;
    loads_ = gather(loads);
    double const enough = accuracy * loads_.norm();
    Eigen::VectorXd place = gather(increment);
    Eigen::VectorXd unbalanced = at(place, increment);
    for (int iteration = 0; iteration < most_iterations && !spent(); ++iteration) {
      if (unbalanced.norm() <= better * enough) break;
      if (by_newton(place, unbalanced, increment)) continue;
      if (unbalanced.norm() <= enough || !by_work(place, unbalanced, increment)) break;
    }
    return unbalanced.norm() <= enough;
  }

 private:
  static constexpr int most_iterations = 100;
  static constexpr int most_questions = 3000;
  static constexpr double better = 1e-3;  ///< of the accuracy asked for, where Newton's method comes that far
  static constexpr double least_share = 0.1;
  static constexpr double decrease = 0.1;     ///< of the imbalance, over the share of Newton's step
  static constexpr double first_way = 1e-4;   ///< [m], of a body that touches nothing
  static constexpr double longest_way = 1.0;  ///< [m]
  static constexpr double least_way = 1e-14;  ///< [m], round-off of places some ten metres from the origin

  bool by_newton(Eigen::VectorXd& place, Eigen::VectorXd& unbalanced, Eigen::VectorXd& increment) {
    auto const tangent = factors(problem_.attached_stiffness());
    if (!tangent.isInvertible()) return false;
    Eigen::VectorXd const direction = -tangent.solve(unbalanced);
    if (direction.norm() < least_way) return false;
    for (double share = 1.0; share > least_share; share *= 0.5) {
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
    auto const held = factors(problem_.held_stiffness());
    Eigen::VectorXd const direction = held.isInvertible()
                                          ? Eigen::VectorXd(-held.solve(unbalanced))
                                          : Eigen::VectorXd(-first_way / unbalanced.norm() * unbalanced);
    if (direction.norm() < least_way) return false;
    double const start = unbalanced.dot(direction);
    auto const work = [&](double share) {
      return share == 0.0 ? start : at(place + share * direction, increment).dot(direction);
    };
    auto const share = share_without_work(work, std::max(1.0, longest_way / direction.norm()));
    if (share) place += *share * direction;
    unbalanced = at(place, increment);
    return share.has_value();
  }

  /// Unbalanced forces [N] with the body at a place.
  Eigen::VectorXd at(Eigen::VectorXd const& place, Eigen::VectorXd& increment) {
    ++asked_;
    for (std::size_t k = 0; k < dofs_.size(); ++k) increment(dofs_[k]) = place(static_cast<Eigen::Index>(k));
    return gather(problem_.attached_forces(increment)) - loads_;
  }

  Eigen::VectorXd gather(Eigen::VectorXd const& all) const {
    Eigen::VectorXd own(static_cast<Eigen::Index>(dofs_.size()));
    for (std::size_t k = 0; k < dofs_.size(); ++k) own(static_cast<Eigen::Index>(k)) = all(dofs_[k]);
    return own;
  }

  /// Of the part of a stiffness beside the mesh.
  Eigen::FullPivLU<Eigen::MatrixXd> factors(Eigen::SparseMatrix<double> const& all) const {
    auto const size = static_cast<Eigen::Index>(dofs_.size());
    Eigen::MatrixXd own(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index k = 0; k < size; ++k)
        own(i, k) = all.coeff(dofs_[static_cast<std::size_t>(i)], dofs_[static_cast<std::size_t>(k)]);
    return Eigen::FullPivLU<Eigen::MatrixXd>(own);
  }

  Problem& problem_;
  std::vector<int> dofs_;  ///< free ones beside the mesh
  Eigen::VectorXd loads_;
  int asked_ = 0;
};

}  // namespace scarp::detail

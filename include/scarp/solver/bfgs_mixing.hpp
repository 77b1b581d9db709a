// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <deque>

#include "scarp/core/index.hpp"
#include "scarp/solver/mixing.hpp"

namespace scarp {

/// Limited-memory BFGS on the displacements of all nodes: the two-loop recursion (Nocedal 1980, Math. Comp. 35; as an iteration on
/// a frozen stiffness Matthies and Strang 1979) with the linear solver's inverse K^-1 at its centre. That inverse is known for
/// all forces that occur, since the corrections are its images, so that no further system is solved. Exact while K stays
/// (`FrozenTangent`). Changes whose work is not positive, as softening and sliding make them, are left out.
class BfgsMixing {
 public:
  int depth = 8;
  double least_cosine = 1e-3;  ///< between change of place and of force below which a change is left out

  void forget() {
    pairs_.clear();
    point_.resize(0);
  }

  /// point and correction K^-1 force [m], unbalanced force [N]: shape (free degrees of freedom)
  Eigen::VectorXd next(Eigen::VectorXd const& point, Eigen::VectorXd const& correction, Eigen::VectorXd const& force) {
    if (point_.size() > 0) remember({point - point_, force_ - force, correction_ - correction});
    point_ = point;
    correction_ = correction;
    force_ = force;

    Eigen::VectorXd rest = force;
    Eigen::VectorXd step = correction;  // K^-1 rest
    std::deque<double> shares;
    for (auto pair = pairs_.rbegin(); pair != pairs_.rend(); ++pair) {
      double const share = pair->moved.dot(rest) / pair->work();
      rest -= share * pair->resisted;
      step -= share * pair->undone;
      shares.push_front(share);
    }
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      step += (shares[k] - pairs_[k].resisted.dot(step) / pairs_[k].work()) * pairs_[k].moved;
    }
    return point + step;
  }

 private:
  struct Pair {
    Eigen::VectorXd moved;     ///< change of place [m]
    Eigen::VectorXd resisted;  ///< change of the internal force with it [N]
    Eigen::VectorXd undone;    ///< K^-1 of that [m]

    double work() const { return moved.dot(resisted); }
  };

  void remember(Pair pair) {
    if (!(pair.work() > least_cosine * pair.moved.norm() * pair.resisted.norm())) return;
    pairs_.push_back(std::move(pair));
    while (detail::count(pairs_) > depth) pairs_.pop_front();
  }

  std::deque<Pair> pairs_;
  Eigen::VectorXd point_;
  Eigen::VectorXd correction_;
  Eigen::VectorXd force_;
};

static_assert(MixingRule<BfgsMixing>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>

#include "scarp/solver/mixing.hpp"
#include "scarp/solver/plain_step.hpp"

namespace scarp {

/// Backtracking that degrades to a plain step. A point at which the forces have grown is left for one between it and the last
/// point, at the zero of the power along the correction where that lies between (Matthies and Strang 1979); after so many
/// tries the iteration goes on from where it is, since forces that jump with the grains may grow along any direction. Every try is
/// an iteration like others: all points answer, and their tangents learn from it.
template <CheckedMixing Direction = PlainStep>
struct LineSearch {
  double worse = 1.2;  ///< growth of the forces, Euclidean norm, that is answered by a shorter step
  int most_tries = 2;  ///< in a row
  double least = 0.1;  ///< share of a step that a try keeps
  double most = 0.5;
  Direction direction{};

  void forget() {
    direction.forget();
    tries_ = 0;
    correction_.resize(0);
  }

  /// point and correction [m], force [N]: shape (free degrees of freedom)
  Eigen::VectorXd next(Eigen::VectorXd const& point, Eigen::VectorXd const& correction, Eigen::VectorXd const& force) {
    bool const grown = correction_.size() > 0 && force.norm() > worse * force_.norm();
    if (grown && tries_ < most_tries) {
      ++tries_;
      double const before = correction_.dot(force_);
      double const now = correction_.dot(force);
      correction_ *= before * now < 0.0 ? std::clamp(before / (before - now), least, most) : most;
      return point_ + correction_;
    }
    tries_ = 0;
    point_ = point;
    force_ = force;
    Eigen::VectorXd const target = mixed(direction, point, correction, force);
    correction_ = target - point;
    return target;
  }

 private:
  int tries_ = 0;
  Eigen::VectorXd point_;  ///< from which the present step was taken
  Eigen::VectorXd force_;  ///< there
  Eigen::VectorXd correction_;
};

static_assert(MixingRule<LineSearch<>>);

}  // namespace scarp

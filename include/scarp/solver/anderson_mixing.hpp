// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/QR>
#include <deque>

#include "scarp/core/index.hpp"

namespace scarp {

/// Anderson mixing of a fixed-point iteration x <- x + d(x): the next iterate minimises the combination of the last
/// corrections in the least-squares sense (Anderson 1965; Walker and Ni 2011, SIAM J. Numer. Anal. 49).
class AndersonMixing {
 public:
  int depth = 6;

  void forget() {
    points_.clear();
    corrections_.clear();
  }

  /// Next iterate from the present one and its correction, same shape.
  Eigen::VectorXd next(Eigen::VectorXd const& point, Eigen::VectorXd const& correction) {
    points_.push_back(point);
    corrections_.push_back(correction);
    while (detail::count(points_) > depth + 1) {
      points_.pop_front();
      corrections_.pop_front();
    }
    auto const history = static_cast<Eigen::Index>(points_.size()) - 1;
    if (history == 0) return point + correction;
    Eigen::MatrixXd changes(point.size(), history);
    Eigen::MatrixXd moves(point.size(), history);
    for (Eigen::Index k = 0; k < history; ++k) {
      auto const i = detail::index(k);
      changes.col(k) = corrections_[i + 1] - corrections_[i];
      moves.col(k) = points_[i + 1] - points_[i];
    }
    // Directions that repeat each other to the threshold are left out; Eigen's plain pivoted QR would divide by them.
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least_squares;
    least_squares.setThreshold(1e-10);
    least_squares.compute(changes);
    Eigen::VectorXd const weights = least_squares.solve(correction);
    return point + correction - (moves + changes) * weights;
  }

 private:
  std::deque<Eigen::VectorXd> points_;
  std::deque<Eigen::VectorXd> corrections_;
};

}  // namespace scarp

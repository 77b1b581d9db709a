// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scarp/core/described.hpp"

namespace scarp::detail {

/// How the free degrees of freedom moved in the last accepted load step.
class ExtrapolatedPredictor {
 public:
  bool known() const { return !motion_.empty(); }
  void forget() { motion_.clear(); }

  /// motion [m]: of the free degrees of freedom in a step, less what the step before had left to it; growth: of the load factor, positive
  void remember(Eigen::VectorXd const& motion, double growth) {
    motion_.assign(motion.begin(), motion.end());
    growth_ = growth;
  }

  /// The motion [m] when the load factor grows by as much.
  /// missing [m]: from where the last step ended to equilibrium; it is made good, and the motion was too small by as much
  Eigen::VectorXd over(double growth, Eigen::VectorXd const& missing) const {
    Eigen::Map<Eigen::VectorXd const> const last(motion_.data(), missing.size());
    return growth / growth_ * (last + missing) + missing;
  }

  SCARP_MEMBERS(motion_, growth_)

 private:
  std::vector<double> motion_;  ///< [m]
  double growth_ = 0.0;
};

}  // namespace scarp::detail

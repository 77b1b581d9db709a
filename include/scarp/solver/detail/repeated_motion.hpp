// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scarp/core/described.hpp"

namespace scarp::detail {

/// How the free degrees of freedom moved in the last accepted load step, for each unit of the load factor.
class RepeatedMotion {
 public:
  bool known() const { return !rate_.empty(); }
  void forget() { rate_.clear(); }

  /// motion [m]: of the free degrees of freedom in a step; growth: of the load factor, positive
  void remember(Eigen::VectorXd const& motion, double growth) {
    rate_.resize(static_cast<std::size_t>(motion.size()));
    rate() = motion / growth;
  }

  /// The motion [m] when the load factor grows by as much.
  Eigen::VectorXd over(double growth) { return growth * rate(); }

  SCARP_MEMBERS(rate_)

 private:
  Eigen::Map<Eigen::VectorXd> rate() { return {rate_.data(), static_cast<Eigen::Index>(rate_.size())}; }

  std::vector<double> rate_;  ///< [m]
};

}  // namespace scarp::detail

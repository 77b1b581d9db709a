// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

namespace scarp {

/// The correction as the linear solver gives it.
struct PlainStep {
  void forget() {}
  Eigen::VectorXd next(Eigen::VectorXd const& point, Eigen::VectorXd const& correction) { return point + correction; }
};

}  // namespace scarp

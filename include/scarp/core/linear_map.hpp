// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <functional>

namespace scarp {

/// A matrix that is applied and never assembled.
using LinearMap = std::function<Eigen::VectorXd(Eigen::VectorXd const&)>;

/// Solves matrix x = right as far as it comes; preconditioner: nearly the inverse.
using LinearIteration = Eigen::VectorXd (*)(LinearMap const& matrix, LinearMap const& preconditioner,
                                            Eigen::VectorXd const& right);

}  // namespace scarp

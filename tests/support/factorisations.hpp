// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

namespace samples {

/// Of a symmetric matrix, increasing.
Eigen::VectorXd eigenvalues(Eigen::MatrixXd const& symmetric);

}  // namespace samples

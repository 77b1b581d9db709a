// SPDX-License-Identifier: BSL-1.0
// What takes long to compile, once for all tests.
#include "support/factorisations.hpp"

#include <Eigen/Eigenvalues>

namespace samples {

Eigen::VectorXd eigenvalues(Eigen::MatrixXd const& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace samples

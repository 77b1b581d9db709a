// SPDX-License-Identifier: BSL-1.0
// Eigen's sparse LU alone: what the needs of programs are measured in.
#include <Eigen/SparseLU>

int main() {
  Eigen::SparseMatrix<double> matrix(3, 3);
  matrix.setIdentity();
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  Eigen::VectorXd const solved = solver.solve(Eigen::VectorXd::Ones(3));
  return solved.sum() == 3.0 ? 0 : 1;
}

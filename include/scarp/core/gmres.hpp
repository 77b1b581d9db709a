// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/linear_map.hpp"
#include "scarp/core/precompiled.hpp"
#ifdef SCARP_DEFINITIONS
#include <Eigen/Householder>
#include <Eigen/Jacobi>
#include <cmath>
#include <limits>
#include <vector>
#endif

namespace scarp {

/// Restarted GMRES (Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856) with Householder's reflections
/// (H. F. Walker, SIAM J. Sci. Stat. Comput. 9 (1988) 152), a LinearIteration. It ends at 1e-4 of the preconditioned
/// residual or after 300 products, or where a singular matrix has no further direction.
SCARP_EXPORT Eigen::VectorXd gmres(LinearMap const& matrix, LinearMap const& preconditioner,
                                   Eigen::VectorXd const& right);

#ifdef SCARP_DEFINITIONS
SCARP_DEFINITIONS Eigen::VectorXd gmres(LinearMap const& matrix, LinearMap const& preconditioner,
                                        Eigen::VectorXd const& right) {
  // Iterations of a load step are as many with 1e-3 as with 1e-8.
  constexpr double accuracy = 1e-4;  // of the preconditioned residual
  constexpr Eigen::Index directions = 60;
  constexpr int max_products = 300;
  constexpr double round_off = 1e-14;  // of a product: what is new in it
  Eigen::Index const size = right.size();
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(size);
  Eigen::VectorXd vector = preconditioner(right);  // the residual, then each direction
  double const first_norm = vector.norm();
  if (right.norm() <= std::numeric_limits<double>::min() || first_norm == 0.0) return solution;
  Eigen::VectorXd scratch(size);
  for (int products = 0;;) {
    // By columns the reflections, below the diagonal, and the triangle that the products became.
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(size, directions + 1);
    Eigen::VectorXd factors = Eigen::VectorXd::Zero(directions + 1);
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(directions + 1);
    std::vector<Eigen::JacobiRotation<double>> rotations(directions);
    auto const reflect = [&](Eigen::Index k, Eigen::VectorXd& to) {
      to.tail(size - k).applyHouseholderOnTheLeft(columns.col(k).tail(size - k - 1), factors(k), scratch.data());
    };
    auto const make_reflection = [&](Eigen::Index k) {
      auto essential = columns.col(k).tail(size - k - 1);
      double length = 0.0;
      vector.tail(size - k).makeHouseholder(essential, factors(k), length);
      return length;
    };
    shares(0) = make_reflection(0);
    Eigen::Index k = 0;
    bool done = false;
    while (!done && k < directions) {
      ++k;
      vector = Eigen::VectorXd::Unit(size, k - 1);
      for (Eigen::Index i = k - 1; i >= 0; --i) reflect(i, vector);
      vector = preconditioner(matrix(vector));
      for (Eigen::Index i = 0; i < k; ++i) reflect(i, vector);
      if (vector.tail(size - k).norm() != 0.0) {
        make_reflection(k);
        reflect(k, vector);
      }
      for (Eigen::Index i = 0; i < k - 1; ++i)
        vector.applyOnTheLeft(i, i + 1, rotations[static_cast<std::size_t>(i)].adjoint());
      if (k < size && vector(k) != 0.0) {
        auto& rotation = rotations[static_cast<std::size_t>(k - 1)];
        rotation.makeGivens(vector(k - 1), vector(k));
        vector.applyOnTheLeft(k - 1, k, rotation.adjoint());
        shares.applyOnTheLeft(k - 1, k, rotation.adjoint());
      }
      columns.col(k - 1).head(k) = vector.head(k);
      done = k == size || std::abs(shares(k)) / first_norm < accuracy || ++products == max_products;
      if (std::abs(vector(k - 1)) <= round_off * vector.head(k).norm()) {
        --k;
        done = true;
      }
    }
    Eigen::VectorXd among = shares.head(k);
    columns.topLeftCorner(k, k).triangularView<Eigen::Upper>().solveInPlace(among);
    vector.setZero();
    for (Eigen::Index i = k - 1; i >= 0; --i) {
      vector(i) += among(i);
      reflect(i, vector);
    }
    solution += vector;
    if (done) return solution;
    vector = preconditioner(right - matrix(solution));
  }
}
#endif

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/gmres.hpp"

#include <doctest/doctest.h>

namespace {

/// Product with a matrix whose diagonal rises evenly from 1 to `last`, with ones above it.
scarp::LinearMap bidiagonal(double last) {
  return [last](Eigen::VectorXd const& x) {
    Eigen::VectorXd forces = Eigen::VectorXd::LinSpaced(x.size(), 1.0, last).cwiseProduct(x);
    forces.head(x.size() - 1) += x.tail(x.size() - 1);
    return forces;
  };
}

Eigen::VectorXd same(Eigen::VectorXd const& x) { return x; }

double residual(scarp::LinearMap const& matrix, Eigen::VectorXd const& right) {
  return (matrix(scarp::gmres(matrix, same, right)) - right).norm() / right.norm();
}

}  // namespace

TEST_CASE("GMRES comes to a residual of 1e-4, also with restarts") {
  for (int const size : {1, 2, 30, 500}) {
    for (double const last : {5.0, 30.0, 600.0}) {
      CAPTURE(size);
      CAPTURE(last);
      CHECK(residual(bidiagonal(last), Eigen::VectorXd::LinSpaced(size, -1.0, 2.0)) < 1e-4);
    }
  }
  int products = 0;
  auto const counted = [&](Eigen::VectorXd const& x) {
    ++products;
    return bidiagonal(600.0)(x);
  };
  CHECK(residual(counted, Eigen::VectorXd::Ones(500)) < 1e-4);
  CHECK(products > 61);  // beyond the directions between two restarts
}

TEST_CASE("GMRES takes one product with the inverse as preconditioner, none for no force, and gives up after 300") {
  int products = 0;
  auto const counted = [&](Eigen::VectorXd const& x) {
    ++products;
    return Eigen::VectorXd(4.0 * x);
  };
  auto const quarter = [](Eigen::VectorXd const& x) { return Eigen::VectorXd(0.25 * x); };
  Eigen::VectorXd const right = Eigen::VectorXd::LinSpaced(20, 1.0, 2.0);
  CHECK((scarp::gmres(counted, quarter, right) - 0.25 * right).norm() < 1e-15);
  CHECK(products == 1);
  CHECK(scarp::gmres(counted, quarter, Eigen::VectorXd::Zero(20)).isZero(0.0));
  CHECK(products == 1);
  // A cyclic shift of 100 places: no combination of fewer than 100 directions is nearer to the solution than nothing.
  auto const shift = [&](Eigen::VectorXd const& x) {
    ++products;
    Eigen::VectorXd moved(x.size());
    moved << x.tail(1), x.head(x.size() - 1);
    return moved;
  };
  CHECK(scarp::gmres(shift, same, Eigen::VectorXd::Unit(100, 0)).norm() < 1e-12);
  CHECK(products <= 1 + 300 + 4);  // and one at each restart
}

TEST_CASE(
    "GMRES of a singular matrix is a number: the solution where there is one, else what is nearest among directions") {
  auto const zero = [](Eigen::VectorXd const& x) { return Eigen::VectorXd(0.0 * x); };
  CHECK(scarp::gmres(zero, same, Eigen::VectorXd::Ones(3)).isZero(0.0));
  auto const flat = [](Eigen::VectorXd const& x) {
    Eigen::VectorXd forces = 2.0 * x;
    forces(2) = 0.0;
    return forces;
  };
  CHECK((scarp::gmres(flat, same, Eigen::Vector3d(1.0, 1.0, 0.0)) - Eigen::Vector3d(0.5, 0.5, 0.0)).norm() < 1e-15);
  CHECK(scarp::gmres(flat, same, Eigen::VectorXd::Unit(3, 2)).isZero(0.0));
  CHECK((flat(scarp::gmres(flat, same, Eigen::VectorXd::Ones(3))) - Eigen::Vector3d(1.0, 1.0, 0.0)).norm() < 1e-14);
  // Free ends: a row of springs, whose forces balance.
  auto const row = [](Eigen::VectorXd const& x) {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(x.size());
    for (Eigen::Index k = 0; k + 1 < x.size(); ++k) {
      forces(k) += x(k) - x(k + 1);
      forces(k + 1) -= x(k) - x(k + 1);
    }
    return forces;
  };
  Eigen::VectorXd pulled = Eigen::VectorXd::Zero(12);
  pulled(0) = -1.0;
  pulled(11) = 1.0;
  CHECK(residual(row, pulled) < 1e-4);
  pulled(5) = 0.5;
  CHECK(scarp::gmres(row, same, pulled).norm() < 1e3);
}

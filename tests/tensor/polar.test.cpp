// SPDX-License-Identifier: BSL-1.0
#include "scarp/tensor/finite_strain.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/core/random.hpp"
#include "support/approx.hpp"

namespace {

/// Entries from -1 to 1 with a determinant above 0.1, so that round-off is not blown up by more than about 100.
template <int Dim>
scarp::Tensor<Dim> random_deformation(scarp::Random& random) {
  scarp::Tensor<Dim> deformation;
  do {
    for (auto& entry : deformation.reshaped()) {
      entry = random.uniform(-1.0, 1.0);
    }
  } while (deformation.determinant() < 0.1);
  return deformation;
}

template <int Dim>
void check_factors(scarp::Random& random) {
  auto const deformation = random_deformation<Dim>(random);
  auto const turn = scarp::rotation_factor<Dim, double>(deformation);
  scarp::Tensor<Dim> const stretch = turn.transpose() * deformation;
  // Analytic: the definition of the polar decomposition, R^T R = I, det R = 1, U = U^T, U positive definite.
  // Round-off of a well-conditioned small matrix.
  CHECK((turn.transpose() * turn - scarp::Tensor<Dim>::Identity()).norm() < 1e-13);
  CHECK(turn.determinant() == samples::Approx(1.0).epsilon(1e-13));
  CHECK((stretch - stretch.transpose()).norm() < 1e-13);
  for (int k = 0; k < 10; ++k) {
    scarp::Vector<Dim> direction;
    for (auto& entry : direction) {
      entry = random.uniform(-1.0, 1.0);
    }
    CHECK(direction.dot(stretch * direction) > 0.0);
  }
}

}  // namespace

TEST_CASE("a deformation is its rotation factor times a symmetric positive stretch") {
  scarp::Random random(11);
  for (int k = 0; k < 50; ++k) {
    check_factors<2>(random);
    check_factors<3>(random);
  }
}

TEST_CASE("a rotation is its own rotation factor at every angle, half a turn included") {
  for (double const angle : {0.0, 1e-9, 0.3, 1.5707963267948966, 3.0, 3.141592653589793, -2.5}) {
    auto const turn = scarp::rotation(angle);
    // Analytic: R = R I. One Newton step from an orthogonal matrix only adds round-off.
    CHECK((scarp::rotation_factor<2, double>(turn) - turn).norm() < 1e-15);
  }
}

TEST_CASE("simple shear turns by half the arc tangent of the shear") {
  for (double const shear : {1e-6, 0.1, 1.0, 5.0, 100.0}) {
    scarp::Tensor<2> deformation = scarp::Tensor<2>::Identity();
    deformation(0, 1) = shear;
    // Analytic: the symmetry of R^T F gives tan(angle) = -shear/2 for simple shear.
    CHECK((scarp::rotation_factor<2, double>(deformation) - scarp::rotation(-std::atan(shear / 2.0))).norm() < 1e-13);
  }
}

TEST_CASE("the rotation factor is found in single precision too") {
  scarp::Tensor<2, float> deformation;
  deformation << 1.0F, 0.5F, 0.0F, 1.0F;
  auto const turn = scarp::rotation_factor<2, float>(deformation);
  CHECK((turn - scarp::rotation(-std::atan(0.25F))).norm() < 1e-6F);  // a few round-offs of float
}

TEST_CASE("the rotation factor of a deformation of any finite size is a rotation") {
  for (double const size : {1e-100, 1e40, 1e150}) {
    scarp::Tensor<2> const deformation = size * scarp::rotation(0.5);
    CHECK((scarp::rotation_factor<2, double>(deformation) - scarp::rotation(0.5)).norm() < 1e-12);
  }
}

TEST_CASE("not a number goes in and comes out, in bounded time") {
  scarp::Tensor<2> deformation = scarp::Tensor<2>::Identity();
  deformation(1, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(scarp::rotation_factor<2, double>(deformation).allFinite());
}

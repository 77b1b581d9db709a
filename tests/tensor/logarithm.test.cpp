// SPDX-License-Identifier: BSL-1.0
#include "scarp/tensor/finite_strain.hpp"

#include <doctest/doctest.h>

#include "support/approx.hpp"

using scarp::Gradient;
using scarp::logarithm_of_increment;
using scarp::Tensor;

TEST_CASE("the logarithm of a stretch is the logarithm of its axes") {
  Gradient<3> gradient = Gradient<3>::Zero();
  gradient.diagonal() << 0.3, -0.25, 1e-9;
  auto const rate = logarithm_of_increment<3>(gradient);
  // Analytic: ln(1 + g) for each axis; round-off of values near one.
  CHECK(rate(0, 0) == samples::Approx(std::log1p(0.3)).epsilon(1e-15));
  CHECK(rate(1, 1) == samples::Approx(std::log1p(-0.25)).epsilon(1e-15));
  CHECK(rate(2, 2) == samples::Approx(std::log1p(1e-9)).epsilon(1e-15));
  CHECK((rate - Tensor<3>(rate.diagonal().asDiagonal())).norm() == 0.0);
}

TEST_CASE("the logarithm of a rotation is the spin by its angle") {
  for (double const angle : {1e-12, 0.01, 0.5, -1.0}) {
    Gradient<2> const gradient = scarp::rotation(angle) - Tensor<2>::Identity();
    Tensor<2> spin;
    spin << 0.0, -angle, angle, 0.0;  // analytic: exp of the skew tensor is the rotation
    CHECK((logarithm_of_increment<2>(gradient) - spin).norm() < 1e-15);  // round-off of 1 + gradient
  }
}

TEST_CASE("the logarithm of simple shear is the shear itself") {
  Gradient<2> gradient = Gradient<2>::Zero();
  gradient(0, 1) = 0.4;
  // Analytic: the shear is nilpotent, so the series ends after its first term.
  CHECK((logarithm_of_increment<2>(gradient) - gradient).norm() < 1e-16);
}

TEST_CASE("an increment beyond the range of the series gives not a number instead of a wrong answer") {
  Gradient<2> inside_out = Gradient<2>::Zero();
  inside_out(0, 0) = -1.5;
  CHECK_FALSE(logarithm_of_increment<2>(inside_out).allFinite());
  Gradient<2> huge = Gradient<2>::Zero();
  huge(1, 1) = 1e6;
  CHECK_FALSE(logarithm_of_increment<2>(huge).allFinite());
  Gradient<2> broken = Gradient<2>::Zero();
  broken(1, 0) = std::nan("");
  CHECK_FALSE(logarithm_of_increment<2>(broken).allFinite());
}

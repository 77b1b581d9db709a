// SPDX-License-Identifier: BSL-1.0
#include "scarp/tensor/finite_strain.hpp"

#include <doctest/doctest.h>

TEST_CASE("a stretch and a rotation after it are told apart") {
  scarp::Tensor<2> stretch;
  stretch << 1.2, 0.1, 0.1, 0.9;
  scarp::Tensor<2> const turn = scarp::rotation(0.8);
  scarp::RotatedIncrement<2> const moved(turn * stretch - scarp::Tensor<2>::Identity());
  REQUIRE(moved.verdict == scarp::Verdict{});
  CHECK((moved.turn - turn).norm() < 1e-14);
  // Analytic: E = 2 (U - I)(U + I)^-1.
  scarp::Tensor<2> const identity = scarp::Tensor<2>::Identity();
  CHECK((moved.strain * (stretch + identity) - 2.0 * (stretch - identity)).norm() < 1e-14);
}

TEST_CASE("what has no rotation says so") {
  using scarp::Reason;
  CHECK(scarp::RotatedIncrement<3>(-scarp::Tensor<3>::Identity()).verdict.reason == Reason::element_inverted);
  CHECK(scarp::RotatedIncrement<2>(scarp::Tensor<2>::Constant(std::nan(""))).verdict.reason == Reason::not_finite);
}

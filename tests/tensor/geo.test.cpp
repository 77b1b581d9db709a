// SPDX-License-Identifier: BSL-1.0
#include "scarp/tensor/geo.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "support/approx.hpp"

namespace {

using scarp::Tensor;

Tensor<2> stretched(double x, double y) {
  Tensor<2> deformation = Tensor<2>::Zero();
  deformation.diagonal() << x, y;
  return deformation;
}

constexpr double round_off = 1e-14;

}  // namespace

TEST_CASE("logarithmic strains of stretch, turn and simple shear have their closed forms") {
  auto const none = scarp::geo::strain<2>(Tensor<2>::Identity());
  CHECK(none.volumetric == 0.0);
  CHECK(none.deviatoric == 0.0);
  // Analytic: principal logarithmic strains ln 0.8 and ln 1.1, whatever turns before or after the stretch.
  for (double const angle : {0.0, 0.7, 2.0}) {
    Tensor<2> const deformation = scarp::rotation(angle) * stretched(0.8, 1.1) * scarp::rotation(0.3 * angle);
    auto const strain = scarp::geo::strain<2>(deformation);
    CHECK(strain.volumetric == samples::Approx(-std::log(0.88)).epsilon(10.0 * round_off));
    CHECK(strain.deviatoric == samples::Approx(std::log(1.1 / 0.8)).epsilon(10.0 * round_off));
  }
  for (double const shear : {1e-6, 0.01, 1.0, 3.0}) {
    Tensor<2> deformation = Tensor<2>::Identity();
    deformation(0, 1) = shear;
    auto const strain = scarp::geo::strain<2>(deformation);
    // Analytic: principal stretches exp(+-asinh(shear/2)). The squared stretches are rounded at 1e-16: absolute error.
    CHECK(std::abs(strain.volumetric) < 1e-14);
    CHECK(std::abs(strain.deviatoric - 2.0 * std::asinh(shear / 2.0)) < 1e-14);
  }
}

TEST_CASE("contraction counts positive") { CHECK(scarp::geo::strain<2>(stretched(0.9, 0.9)).volumetric > 0.2); }

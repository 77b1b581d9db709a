// SPDX-License-Identifier: BSL-1.0
#include "scarp/tensor/principal.hpp"

#include <doctest/doctest.h>

#include "scarp/core/random.hpp"
#include "support/approx.hpp"
#include "support/factorisations.hpp"

TEST_CASE_TEMPLATE("the largest principal value is that of the eigenvalues, in any axes", Dimension,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  scarp::Random random(5);
  for (int k = 0; k < 200; ++k) {
    scarp::Tensor<dim> any;
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) any(i, j) = random.uniform(-1.0, 1.0);
    }
    scarp::Tensor<dim> const symmetric = (any + any.transpose()) / 2.0;
    CHECK(scarp::largest_principal<dim>(symmetric) ==
          samples::Approx(samples::eigenvalues(symmetric).cwiseAbs().maxCoeff()).epsilon(1e-13));
  }
}

TEST_CASE("special tensors: nothing, a multiple of the identity, two equal values, NaN") {
  CHECK(scarp::largest_principal<3>(scarp::Tensor<3>::Zero()) == 0.0);
  CHECK(scarp::largest_principal<3>(-2.0 * scarp::Tensor<3>::Identity()) == 2.0);
  scarp::Tensor<3> disc = scarp::Tensor<3>::Identity();
  disc(2, 2) = -3.0;
  CHECK(scarp::largest_principal<3>(disc) == samples::Approx(3.0).epsilon(1e-15));
  disc(0, 1) = disc(1, 0) = std::nan("");
  CHECK(std::isnan(scarp::largest_principal<3>(disc)));
  scarp::Tensor<2> plane = scarp::Tensor<2>::Zero();
  plane(0, 0) = std::nan("");
  CHECK(std::isnan(scarp::largest_principal<2>(plane)));
}

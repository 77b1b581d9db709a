// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/block/small_tensor.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "scarp/core/random.hpp"
#include "scarp/dem/block/block_packings.hpp"
#include "support/approx.hpp"

namespace {

using scarp::Tensor;
using scarp::detail::as_tensor;
using scarp::detail::row_by_row;

}  // namespace

TEST_CASE_TEMPLATE("small tensors agree with Eigen's", Dim, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>) {
  constexpr int dim = Dim::value;
  scarp::Random random(11);
  for (int draw = 0; draw < 50; ++draw) {
    Tensor<dim> a, b;
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) {
        a(i, j) = random.uniform(-1.0, 1.0) + (i == j ? 2.5 : 0.0);  // far from singular
        b(i, j) = random.uniform(-1.0, 1.0);
      }
    }
    auto const small = row_by_row<dim>(a);
    CHECK((as_tensor<dim>(small) - a).norm() == 0.0);
    double const determinant = a.determinant();
    CHECK(scarp::detail::determinant_of<dim>(small) == samples::Approx(determinant).epsilon(1e-13));
    Tensor<dim> const inverse = a.inverse();
    CHECK((as_tensor<dim>(scarp::detail::inverse_of<dim>(small)) - inverse).norm() < 1e-13);
    CHECK((as_tensor<dim>(scarp::detail::adjugate_of<dim>(small)) - determinant * inverse).norm() < 1e-11);
    CHECK((as_tensor<dim>(scarp::detail::product_of<dim>(small, row_by_row<dim>(b))) - a * b).norm() < 1e-13);
    CHECK(scarp::detail::size_of_tensor<dim>(small) == samples::Approx(a.norm()).epsilon(1e-14));
    Tensor<dim> const square = a * a.transpose();
    Eigen::SelfAdjointEigenSolver<Tensor<dim>> const solver(square);
    CHECK(scarp::detail::largest_principal_of<dim>(row_by_row<dim>(square)) ==
          samples::Approx(solver.eigenvalues()(dim - 1)).epsilon(1e-12));
  }
}

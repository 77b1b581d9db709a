// SPDX-License-Identifier: BSL-1.0
#include "scarp/tensor/voigt.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "scarp/core/random.hpp"

namespace {

template <int Dim>
scarp::Tensor<Dim> random_tensor(scarp::Random& random) {
  scarp::Tensor<Dim> tensor;
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) tensor(i, j) = random.uniform(-1.0, 1.0);
  }
  return tensor;
}

template <int Dim>
struct Dimension {
  static constexpr int value = Dim;
};

}  // namespace

TEST_CASE("Voigt stress is ordered xx, yy, xy in 2D and xx, yy, zz, yz, zx, xy in 3D") {
  // Analytic: the order is a definition; each component of these tensors is its own label.
  scarp::Tensor<2> plane;
  plane << 11.0, 12.0, 12.0, 22.0;
  CHECK(scarp::to_voigt_stress<2, double>(plane) == scarp::VoigtStress<2>(11.0, 22.0, 12.0));

  scarp::Tensor<3> solid;
  solid << 11.0, 12.0, 13.0, 12.0, 22.0, 23.0, 13.0, 23.0, 33.0;
  scarp::VoigtStress<3> expected;
  expected << 11.0, 22.0, 33.0, 23.0, 13.0, 12.0;
  CHECK(scarp::to_voigt_stress<3, double>(solid) == expected);
}

TEST_CASE("simple shear by gamma has the engineering shear strain gamma and no other") {
  scarp::Gradient<2> plane = scarp::Gradient<2>::Zero();
  plane(0, 1) = 0.375;  // analytic: gamma_xy = du_x/dy + du_y/dx
  CHECK(scarp::to_engineering_strain<2, double>(plane) == scarp::EngineeringStrain<2>(0.0, 0.0, 0.375));

  scarp::Gradient<3> solid = scarp::Gradient<3>::Zero();
  solid(2, 0) = 0.375;  // du_z/dx, the fifth component in 3D
  scarp::EngineeringStrain<3> expected = scarp::EngineeringStrain<3>::Zero();
  expected(4) = 0.375;
  CHECK(scarp::to_engineering_strain<3, double>(solid) == expected);
}

TEST_CASE_TEMPLATE("a symmetric stress survives the way to Voigt form and back", Dim, Dimension<2>, Dimension<3>) {
  constexpr int dim = Dim::value;
  std::uint64_t const seed = 11;
  CAPTURE(seed);
  scarp::Random random(seed);
  scarp::Tensor<dim> const any = random_tensor<dim>(random);
  scarp::Tensor<dim> const stress = any + any.transpose();
  // Exact: the mean of two equal numbers is that number.
  CHECK(scarp::from_voigt_stress<dim, double>(scarp::to_voigt_stress<dim, double>(stress)) == stress);
}

TEST_CASE_TEMPLATE("the skew part of a tensor reaches neither stress nor strain", Dim, Dimension<2>, Dimension<3>) {
  constexpr int dim = Dim::value;
  std::uint64_t const seed = 12;
  CAPTURE(seed);
  scarp::Random random(seed);
  scarp::Tensor<dim> const any = random_tensor<dim>(random);
  scarp::Tensor<dim> const skew = any - any.transpose();
  CHECK(scarp::to_voigt_stress<dim, double>(skew) == scarp::VoigtStress<dim>::Zero());
  CHECK(scarp::to_engineering_strain<dim, double>(skew) == scarp::EngineeringStrain<dim>::Zero());
}

TEST_CASE_TEMPLATE("Voigt stress times engineering strain is the work of the tensors", Dim, Dimension<2>,
                   Dimension<3>) {
  // Analytic: sigma : eps = sum of Voigt products, because engineering shear counts both off-diagonal parts.
  constexpr int dim = Dim::value;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    scarp::Random random(seed);
    scarp::Tensor<dim> const any = random_tensor<dim>(random);
    scarp::Tensor<dim> const stress = any + any.transpose();
    scarp::Gradient<dim> const gradient = random_tensor<dim>(random);
    double const work = stress.cwiseProduct(gradient).sum();
    double const voigt_work =
        scarp::to_voigt_stress<dim, double>(stress).dot(scarp::to_engineering_strain<dim, double>(gradient));
    // Tolerance: at most 9 products of size up to 2 and as many sums, each rounded once.
    CHECK(std::abs(voigt_work - work) <= 2.0 * 9.0 * 9.0 * std::numeric_limits<double>::epsilon());
  }
}

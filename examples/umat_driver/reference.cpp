// SPDX-License-Identifier: BSL-1.0
// The same increments by MaterialPoints in C++, without libscarp_points.
#include <cstdio>
#include <variant>

#include "host.h"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/random_packings.hpp"
#include "scarp/shape/disc.hpp"
#include "umat_components.hpp"

struct reference {
  std::variant<scarp::MaterialPoints<2>, scarp::MaterialPoints<3>> point;
};

namespace {

using Grains = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;

scarp::DemRve<Grains, scarp::SamePacking<Grains>> discs() {
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  scarp::IsotropicRecipe<Grains, scarp::DiscGrading> const recipe{
      .cloud = {.grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = 100, .density = 2650.0, .thickness = 0.2},
      .preparation = {.pressure = 1e5},
      .law = law};
  return {.law = law, .source = {recipe(1).packing}};
}

template <int Dim, class Provider>
scarp::MaterialPoints<Dim> one_point(Provider const& provider) {
  return {provider, std::array{scarp::Site<Dim>{}}};
}

reference make(int material) {
  auto const elastic = scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3);
  if (material == ELASTIC) return {one_point<2>(scarp::LinearElastic<2>{elastic})};
  if (material == ELASTIC_IN_SPACE) return {one_point<3>(scarp::LinearElastic<3>{elastic})};
  if (material == DISCS) return {one_point<2>(discs())};
  double const degree = std::numbers::pi / 180.0;
  return {one_point<2>(scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>{
      elastic, {{.cohesion = 1e3, .friction = 30.0 * degree, .dilation = 5.0 * degree}}, {.surcharge = 1e3}})};
}

template <class Matrix>
void copy_rows(Matrix const& matrix, double* to) {
  for (int i = 0; i < matrix.rows(); ++i) {
    for (int j = 0; j < matrix.cols(); ++j) *to++ = matrix(i, j);
  }
}

}  // namespace

extern "C" {

reference* reference_new(int material) try {
  return new reference(make(material));
} catch (std::exception const& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return nullptr;
}
void reference_free(reference* point) { delete point; }

int reference_step(reference* point, double const* gradient, double* stress, double* tangent) {
  return std::visit(
      [&]<int dim>(scarp::MaterialPoints<dim>& one) {
        one.gradient(0) = Eigen::Map<Eigen::Matrix<double, dim, dim, Eigen::RowMajor> const>(gradient);
        scarp::SerialExecutor serial;
        bool const good = one.respond(serial).verdict.acceptable();
        copy_rows(one.stress(0), stress);
        copy_rows(one.tangent(0), tangent);
        good ? one.commit() : one.discard();
        return good ? 1 : 0;
      },
      point->point);
}

void reference_gradient(int dimension, int components, double const* strain, double* gradient) {
  auto const layout = points_library::Components::of(dimension, components, false);
  auto const whole = points_library::gradient_of(layout.strain_tensor(strain), scarp::Tensor<3>::Identity());
  copy_rows(whole.topLeftCorner(dimension, dimension), gradient);
}
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/points/laboratory_results.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/points/laboratory_paths.hpp"
#include "scarp/points/mohr_coulomb_reading.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Approx;
using Rows = std::vector<scarp::LaboratoryRow<2>>;

constexpr double degree = std::numbers::pi / 180.0;

template <int Dim, class Provider>
auto rows_of(Provider const& provider, scarp::PathConditions<Dim> const& conditions, double length, int count) {
  scarp::MaterialPoints<Dim> points(provider, std::array{scarp::Site<Dim>{}});
  scarp::PointPath<Dim> path(points, conditions, {.tolerance = 1e-11});
  scarp::SerialExecutor serial;
  std::vector<scarp::LaboratoryRow<Dim>> rows{{0.0, path.stress(0), path.strain(0)}};
  for (int k = 0; k < count; ++k) {
    REQUIRE(path.advance(length / count, serial).verdict.acceptable());
    rows.push_back({path.length(), path.stress(0), path.strain(0)});
  }
  return rows;
}

/// Drained compression at a lateral pressure of 1 with deviators and volumetric strains of functions of the axial strain.
template <class Deviator, class Volume>
Rows drawn(Deviator const& deviator, Volume const& volume, double end, int count) {
  Rows rows;
  for (int k = 0; k <= count; ++k) {
    double const axial = end * k / count;
    rows.push_back({axial, {-1.0, -1.0 - deviator(axial), 0.0}, {axial - volume(axial), -axial, 0.0}});
  }
  return rows;
}

}  // namespace

TEST_CASE_TEMPLATE("Mohr-Coulomb parameters are read from Mohr-Coulomb's own curve", Number,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Number::value;
  scarp::MohrCoulomb<dim, scarp::GeostaticStress<dim>> const soil{
      scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3),
      {{.friction = 35.0 * degree, .dilation = 8.0 * degree}},
      {.surcharge = 1e5}};
  auto const rows = rows_of<dim>(soil, scarp::drained_path<dim>(), 0.04, 400);
  auto const results = scarp::laboratory_results<dim>(rows);
  // The elastic strain of an increment is its logarithm to 1e-9; the curve is straight to its corner, but for the row across it.
  CHECK(results.peak.friction() == Approx(35.0 * degree).epsilon(1e-9));
  CHECK(results.residual.friction() == Approx(35.0 * degree).epsilon(1e-9));
  CHECK(results.peak_dilation == Approx(8.0 * degree).epsilon(1e-6));
  CHECK(results.shear_modulus == Approx(20e6 / 2.6).epsilon(1e-8));
  CHECK(results.k0 == Approx((1.0 - std::sin(35.0 * degree)) / (1.0 + std::sin(35.0 * degree))).epsilon(1e-9));
  auto const read = scarp::mohr_coulomb_of(results);
  CHECK(read.elasticity.shear_modulus == Approx(20e6 / 2.6).epsilon(1e-6));
  CHECK(read.elasticity.lame_lambda == Approx(soil.elasticity.lame_lambda).epsilon(1e-6));
  CHECK(read.strength.strength.friction == results.peak.friction());
  // Contraction ends at the corner: the last elastic row.
  REQUIRE(results.phase_transformation);
  CHECK(results.phase_transformation->q() <= results.peak.q());
  CHECK(results.phase_transformation->q() > 0.9 * results.peak.q());
}

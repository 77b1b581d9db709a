// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/hydraulic.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("water is stored by the share of the pores and its compressibility") {
  scarp::Water const water{.bulk_modulus = 2e8};
  // Analytic: a void ratio of 0.6 is a porosity of 3/8.
  CHECK(water.storage(0.6) == samples::Approx(0.375 / 2e8).epsilon(1e-14));
  CHECK(scarp::Water{.bulk_modulus = infinity}.storage(0.6) == 0.0);
  CHECK(scarp::ConstantPermeability{.water = water}.storage(0.6) == water.storage(0.6));
  CHECK(scarp::KozenyCarman{.grain = 1e-4, .water = water}.storage(0.6) == water.storage(0.6));
}

TEST_CASE("a constant permeability is that of Darcy's law, whatever the void ratio") {
  scarp::ConstantPermeability const flow{.conductivity = 3e-5, .water = {.unit_weight = 1e4}};
  for (double const void_ratio : {0.4, 0.9}) CHECK(flow.mobility(void_ratio) == samples::Approx(3e-9).epsilon(1e-14));
}

TEST_CASE("a packing's permeability is that of Kozeny and Carman") {
  scarp::KozenyCarman const flow{.grain = 3e-4, .factor = 150.0, .water = {.viscosity = 2e-3}};
  // Analytic: k = d^2/150 n^3/(1-n)^2 with n = 3/8.
  double const permeability = 9e-8 / 150.0 * 0.375 * 0.375 * 0.375 / (0.625 * 0.625);
  CHECK(flow.mobility(0.6) == samples::Approx(permeability / 2e-3).epsilon(1e-14));
  CHECK(scarp::KozenyCarman{.grain = 3e-4}.factor == 180.0);
}

TEST_CASE("properties of the pore water and the flow are rejected by name") {
  CHECK_NOTHROW(scarp::Water{}.validate());
  CHECK_NOTHROW(scarp::Water{.bulk_modulus = infinity}.validate());
  CHECK_REFUSED(scarp::Water{.bulk_modulus = 0.0}.validate(), "bulk modulus of the pore water");
  CHECK_REFUSED(scarp::Water{.unit_weight = infinity}.validate(), "unit weight of the pore water");
  CHECK_REFUSED(scarp::Water{.viscosity = -1.0}.validate(), "viscosity of the pore water");
  CHECK_NOTHROW(scarp::ConstantPermeability{}.validate());
  CHECK_REFUSED(scarp::ConstantPermeability{.conductivity = -1.0}.validate(), "hydraulic conductivity");
  CHECK_REFUSED(scarp::ConstantPermeability{.water = {.viscosity = 0.0}}.validate(), "viscosity of the pore water");
  CHECK_NOTHROW(scarp::KozenyCarman{.grain = 1e-4}.validate());
  CHECK_REFUSED(scarp::KozenyCarman{}.validate(), "grain diameter");
  CHECK_REFUSED((scarp::KozenyCarman{.grain = 1e-4, .factor = 0.0}.validate()), "factor of a permeability");
  CHECK_REFUSED((scarp::KozenyCarman{.grain = 1e-4, .water = {.viscosity = 0.0}}.validate()), "viscosity");
  CHECK_REFUSED(scarp::KozenyCarman::of_conductivity(1e-4, 0.6, {.viscosity = -1e-3}), "viscosity");
}

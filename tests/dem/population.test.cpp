// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/population.hpp"

#include <doctest/doctest.h>

#include "scarp/shape/disc.hpp"

using Discs = scarp::Population<scarp::Disc>;

TEST_CASE("grains of a negative density or thickness are refused") {
  CHECK_THROWS_AS(Discs({{1.0}}, -1.0, 1.0), scarp::InputError);
  CHECK_THROWS_AS(Discs({{1.0}}, 1.0, -1.0), scarp::InputError);
}

TEST_CASE("grains whose mass or inertia is beyond the numbers are refused") {
  CHECK_NOTHROW(Discs({{1e70}}, 1.0, 1.0));
  CHECK_THROWS_AS(Discs({{1e100}}, 1.0, 1.0), scarp::InputError);  // a mass of 1e200 kg, an inertia of 1e400
  CHECK_THROWS_AS(Discs({{1e-78}}, 1.0, 1.0), scarp::InputError);  // inertia has lost digits
  CHECK_THROWS_AS(Discs({{1e-100}}, 1.0, 1.0), scarp::InputError);
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/population.hpp"

#include <doctest/doctest.h>

#include "scarp/shape/disc.hpp"
#include "support/refusals.hpp"

using Discs = scarp::Population<scarp::Disc>;

TEST_CASE("grains of a negative density or thickness are refused") {
  CHECK_REFUSED(Discs({{1.0}}, -1.0, 1.0), "density is -1");
  CHECK_REFUSED(Discs({{1.0}}, 1.0, -1.0), "thickness is -1");
}

TEST_CASE("grains whose mass or inertia is beyond the numbers are refused") {
  CHECK_NOTHROW(Discs({{1e70}}, 1.0, 1.0));
  CHECK_REFUSED(Discs({{1e100}}, 1.0, 1.0), "size 1e+100");  // a mass of 1e200 kg, an inertia of 1e400
  CHECK_REFUSED(Discs({{1e-78}}, 1.0, 1.0), "size 1e-78");   // inertia has lost digits
  CHECK_REFUSED(Discs({{1e-100}}, 1.0, 1.0), "size 1e-100");
}

TEST_CASE("grains whose mass or inertia is beyond single precision are refused there") {
  using Single = scarp::Population<scarp::Disc, float>;
  CHECK_NOTHROW(Single({{1e-3}}, 2650.0, 1.0));
  CHECK_REFUSED(Single({{1e-11}}, 2650.0, 1.0), "beyond what a number here can hold");
  CHECK_REFUSED(Single({{1e20}}, 2650.0, 1.0), "beyond what a number here can hold");
  CHECK_NOTHROW(Discs({{1e-11}}, 2650.0, 1.0));
}

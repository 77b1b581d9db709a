// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/sieve_curve.hpp"

#include <doctest/doctest.h>

#include "support/refusals.hpp"

namespace {

using scarp::SieveCurve;

// Definition: of grains that are drawn by number, each sieve passes the stated share of the mass.
TEST_CASE("sieving the grains that a curve gives returns the curve") {
  SieveCurve const curve{{1e-3, 2e-3, 4e-3, 5e-3}, {0.0, 0.2, 0.9, 1.0}};
  curve.validate();
  for (int const dim : {2, 3}) {
    CAPTURE(dim);
    scarp::Random random(7);
    constexpr int grains = 200'000;
    double mass = 0.0, below_second = 0.0, below_third = 0.0, below_between = 0.0;
    for (int k = 0; k < grains; ++k) {
      double const diameter = curve.sample(random, dim);
      REQUIRE((diameter >= 1e-3 * (1.0 - 1e-12) && diameter <= 5e-3 * (1.0 + 1e-12)));
      double const own = std::pow(diameter, dim);
      mass += own;
      if (diameter < 2e-3) below_second += own;
      if (diameter < std::sqrt(8.0) * 1e-3) below_between += own;  // halfway in the logarithm
      if (diameter < 4e-3) below_third += own;
    }
    // Few large grains carry the mass: the share scatters by less than 0.004.
    CHECK(std::abs(below_second / mass - 0.2) < 0.015);
    CHECK(std::abs(below_between / mass - 0.55) < 0.015);
    CHECK(std::abs(below_third / mass - 0.9) < 0.015);
  }
}

TEST_CASE("sieve curves that are none are rejected") {
  CHECK_REFUSED((SieveCurve{{1e-3}, {0.0}}.validate()), "1 diameters");
  CHECK_REFUSED((SieveCurve{{2e-3, 1e-3}, {0.0, 1.0}}.validate()), "0.001 m");
  CHECK_REFUSED((SieveCurve{{1e-3, 2e-3}, {0.1, 1.0}}.validate()), "from 0.1 to 1");
  CHECK_REFUSED((SieveCurve{{1e-3, 2e-3}, {0.0, 1.5}}.validate()), "1.5");
}

}  // namespace

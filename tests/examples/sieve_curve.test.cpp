// SPDX-License-Identifier: BSL-1.0
#include "../../examples/shared/sand/sieve_curve.hpp"

#include <doctest/doctest.h>

#include "support/refusals.hpp"

namespace {

using examples::SieveCurve;

// Definition: of grains that are drawn by number, each sieve passes the stated share of the mass.
TEST_CASE("sieving the grains that a curve gives returns the curve") {
  SieveCurve const curve{{1e-3, 2e-3, 4e-3, 5e-3}, {0.0, 0.2, 0.9, 1.0}};
  curve.validate();
  for (int const dim : {2, 3}) {
    CAPTURE(dim);
    scarp::Random random(7);
    double mass = 0.0, below_second = 0.0, below_third = 0.0, below_between = 0.0;
    for (double const diameter : curve.sample(random, dim, 200'000)) {
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

// Of a curve over a decade chance draws too few large grains: classes of equal number have the curve's mass all the
// same.
TEST_CASE("few grains of a wide curve have its mass, and fewer are rejected with what would do") {
  SieveCurve const curve{{5e-4, 2e-3, 5e-3}, {0.0, 0.4, 1.0}};
  for (auto const& [dim, grains] : {std::pair{2, 250}, std::pair{3, 1000}}) {
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
      CAPTURE(seed);
      scarp::Random random(seed);
      double mass = 0.0, below = 0.0, largest = 0.0;
      for (double const diameter : curve.sample(random, dim, grains)) {
        double const own = std::pow(diameter, dim);
        mass += own;
        if (diameter <= 2e-3) below += own;
        largest = std::max(largest, diameter);
      }
      CHECK(std::abs(below / mass - 0.4) <= 0.1);
      CHECK(largest > 3.5e-3);
      CHECK(largest <= 5e-3);
    }
  }
  scarp::Random random(1);
  auto const draw = [&](SieveCurve const& wide, int dim, int grains) {
    static_cast<void>(wide.sample(random, dim, grains));
  };
  SieveCurve const wide{{1e-4, 1e-3, 1e-2}, {0.0, 0.5, 1.0}};
  auto const said = samples::message_of([&] { draw(wide, 2, 300); });
  CAPTURE(said);
  CHECK(samples::contains(said, "300 grains cannot have the sieve curve from 0.0001 to 0.01 m"));
  // Half of the mass in each decade is uniform over ln d, hence numbers are as differences of 1 / d^2; a tenth of the
  // mass lies above d90.
  int needed = 0;
  double begin = 0.0;
  REQUIRE(std::sscanf(said.substr(said.find("take ")).c_str(), "take %d grains, or begin the curve at %lf", &needed,
                      &begin) == 2);
  double const d90 = 1e-2 * std::pow(10.0, -0.2);
  double const number = (1.0 / (1e-4 * 1e-4) - 1.0 / (1e-2 * 1e-2)) / (1.0 / (d90 * d90) - 1.0 / (1e-2 * 1e-2));
  CHECK(std::abs(needed - number) <= 1.0);
  CHECK_NOTHROW(draw(wide, 2, needed));
  CHECK_NOTHROW(draw({{begin * 1.01, 1e-2}, {0.0, 1.0}}, 2, 300));
  CHECK_REFUSED(draw({{begin * 0.9, 1e-2}, {0.0, 1.0}}, 2, 300), "cannot have the sieve curve");
}

TEST_CASE("sieve curves that are none are rejected") {
  CHECK_REFUSED((SieveCurve{{1e-3}, {0.0}}.validate()), "1 diameters");
  CHECK_REFUSED((SieveCurve{{2e-3, 1e-3}, {0.0, 1.0}}.validate()), "0.001 m");
  CHECK_REFUSED((SieveCurve{{1e-3, 2e-3}, {0.1, 1.0}}.validate()), "from 10 % to 100 %");
  CHECK_REFUSED((SieveCurve{{1e-3, 2e-3}, {0.0, 1.5}}.validate()), "1.5");
}

}  // namespace

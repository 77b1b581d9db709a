// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace {

std::uint64_t thousandth(std::uint64_t seed) {
  scarp::Random random(seed);
  for (int k = 0; k < 999; ++k) random.next();
  return random.next();
}

}  // namespace

// Expected values in this file: another code, tests/core/random_reference.py (`python3
// tests/core/random_reference.py`), which checks itself against published sequences.

TEST_CASE("the generator draws the numbers of xoshiro256++ seeded by splitmix64") {
  scarp::Random from_zero(0);
  CHECK(from_zero.next() == 5987356902031041503ULL);
  CHECK(from_zero.next() == 7051070477665621255ULL);
  CHECK(from_zero.next() == 6633766593972829180ULL);
  CHECK(from_zero.next() == 211316841551650330ULL);

  scarp::Random from_the_largest_seed(~0ULL);
  CHECK(from_the_largest_seed.next() == 6254647548650071986ULL);
  CHECK(from_the_largest_seed.next() == 16610832622747802512ULL);

  CHECK(thousandth(0) == 3991034768575652995ULL);
  CHECK(thousandth(20260) == 2621011974123401631ULL);
  CHECK(thousandth(~0ULL) == 7955597261603557472ULL);
}

TEST_CASE("a uniform number is the upper 53 bits of a draw, without rounding") {
  scarp::Random random(20260);
  CHECK(random.uniform() == 0.21965925835362088);
  CHECK(random.uniform() == 0.20921996060472436);
}

TEST_CASE("uniform numbers stay in their range and have its mean and variance") {
  scarp::Random random(5);
  int const draws = 100000;
  double smallest = 1.0;
  double largest = 0.0;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (int k = 0; k < draws; ++k) {
    double const drawn = random.uniform();
    smallest = std::min(smallest, drawn);
    largest = std::max(largest, drawn);
    sum += drawn;
    sum_of_squares += drawn * drawn;
  }
  CHECK(smallest >= 0.0);
  CHECK(largest < 1.0);
  // Analytic: mean 1/2, second moment 1/3. Tolerance: five standard errors, sqrt(1/12) and sqrt(4/45) over sqrt(draws).
  CHECK(std::abs(sum / draws - 0.5) < 5.0 * std::sqrt(1.0 / 12.0 / draws));
  CHECK(std::abs(sum_of_squares / draws - 1.0 / 3.0) < 5.0 * std::sqrt(4.0 / 45.0 / draws));
}

TEST_CASE("a uniform number between two bounds is the unit number stretched to them") {
  scarp::Random unit(7);
  scarp::Random stretched(7);
  for (int k = 0; k < 100; ++k) {
    double const low = -3.0;
    double const high = 5.0;
    CHECK(stretched.uniform(low, high) == low + 8.0 * unit.uniform());  // 8 is a power of two: exact product
  }
}

TEST_CASE("a copy of the generator continues with the same numbers, another seed does not") {
  scarp::Random original(1);
  original.next();
  scarp::Random copy = original;
  CHECK(copy.next() == original.next());
  CHECK(scarp::Random(1).next() != scarp::Random(2).next());
}

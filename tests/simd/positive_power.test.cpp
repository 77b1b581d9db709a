// SPDX-License-Identifier: BSL-1.0
#include "scarp/simd/positive_power.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scarp/core/random.hpp"

namespace lanes = scarp::lanes;

#define EVERY_WIDTH                                                                                                   \
  lanes::BasicPack<double, 1>, lanes::BasicPack<double, 2>, lanes::BasicPack<double, 4>, lanes::BasicPack<double, 8>, \
      lanes::BasicPack<float, 4>, lanes::BasicPack<float, 8>

// Against std::pow of long doubles; the bound is the one that the header states.
TEST_CASE_TEMPLATE("powers of positive numbers by polynomials keep the stated error", Pack, EVERY_WIDTH) {
  using Scalar = typename Pack::value_type;
  bool const is_double = sizeof(Scalar) == 8;
  double const bound = is_double ? 5e-16 : 3e-7;
  scarp::Random random(1700);
  double worst = 0.0;
  for (int draw = 0; draw < 100'000; ++draw) {
    auto const base = static_cast<Scalar>(std::exp2(random.uniform(-60.0, draw % 2 == 0 ? 0.0 : 60.0)));
    double const limit = (is_double ? 1000.0 : 120.0) / std::max(std::abs(std::log2(static_cast<double>(base))), 1.0);
    auto const exponent = static_cast<Scalar>(random.uniform(-1.0, 1.0) * std::min(limit, 20.0));
    auto const exact = std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
    Pack const found = lanes::positive_power(Pack(base), Pack(exponent));
    auto const error = static_cast<double>(std::abs(static_cast<long double>(found[Pack::size() - 1]) / exact - 1.0L));
    worst = std::max(worst, error / (1.0 + std::abs(static_cast<double>(std::log(exact)))));
  }
  CHECK(worst < bound);
  CHECK(worst > 0.0);
}

TEST_CASE_TEMPLATE("whole powers of two are exact, lanes are independent, and results end at the range", Pack,
                   EVERY_WIDTH) {
  using Scalar = typename Pack::value_type;
  Pack bases(0);
  for (std::size_t lane = 0; lane < Pack::size(); ++lane) bases.vector[lane] = static_cast<Scalar>(1u << (lane % 4));
  Pack const cubes = lanes::positive_power(bases, Pack(Scalar(3)));
  for (std::size_t lane = 0; lane < Pack::size(); ++lane) CHECK(cubes[lane] == std::pow(bases[lane], Scalar(3)));
  int const end = sizeof(Scalar) == 8 ? 1021 : 125;
  CHECK(lanes::positive_power(Pack(Scalar(0.5)), Pack(Scalar(5000)))[0] == std::ldexp(Scalar(1), -end));
  CHECK(lanes::positive_power(Pack(Scalar(2)), Pack(Scalar(5000)))[0] == std::ldexp(Scalar(1), end));
}

TEST_CASE_TEMPLATE("powers side by side are those one by one", Pack, EVERY_WIDTH) {
  using Scalar = typename Pack::value_type;
  std::array<Pack, 2> const bases{Pack(Scalar(0.3)), Pack(Scalar(7))};
  std::array<Pack, 2> const exponents{Pack(Scalar(2.5)), Pack(Scalar(-0.7))};
  auto const both = lanes::positive_powers(bases, exponents);
  // One division serves both, which may cost a digit.
  Scalar const digit = 4 * std::numeric_limits<Scalar>::epsilon();
  for (std::size_t k = 0; k < 2; ++k) {
    Scalar const alone = lanes::positive_power(bases[k], exponents[k])[0];
    CHECK(std::abs(both[k][0] - alone) <= digit * alone);
  }
}

// Against std::pow of long doubles; results lie between 1 and 2.
TEST_CASE_TEMPLATE("roots of numbers from 1 to 2 err by a few last digits", Pack, EVERY_WIDTH) {
  using Scalar = typename Pack::value_type;
  scarp::Random random(1701);
  double worst = 0.0;
  for (int draw = 0; draw < 100'000; ++draw) {
    auto const base = static_cast<Scalar>(random.uniform(1.0, 2.0));
    auto const exponent = static_cast<Scalar>(random.uniform(0.0, 1.0));
    auto const exact = std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
    auto const found =
        lanes::small_powers<Scalar, Pack::size(), 2>({Pack(base), Pack(Scalar(1))}, {Pack(exponent), Pack(exponent)});
    worst = std::max({worst, static_cast<double>(std::abs(static_cast<long double>(found[0][0]) / exact - 1.0L)),
                      static_cast<double>(std::abs(found[1][0] - Scalar(1)))});
  }
  CHECK(worst < 4.0 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()));
  CHECK(worst > 0.0);
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/simd/square_roots.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "scarp/core/random.hpp"

namespace {

/// Roots of random numbers of all magnitudes, another one in each lane.
template <class T>
void check_square_roots() {
  using Scalar = typename scarp::ScalarOf<T>::type;
  // A rounding each of the product, the series and the sum, and half of one left by the series.
  constexpr Scalar bound = 2 * std::numeric_limits<Scalar>::epsilon();
  double const range = 0.95 * std::log(static_cast<double>(std::numeric_limits<Scalar>::max()));
  scarp::Random random(7);
  for (int draw = 0; draw < 5'000; ++draw) {
    auto const number = [&] { return static_cast<Scalar>(std::exp(range * random.uniform(-1.0, 1.0))); };
    std::array<T, 2> asked;
    if constexpr (std::is_same_v<T, Scalar>) {
      asked = {number(), number()};
    } else {
      for (T& values : asked) {
        for (std::size_t lane = 0; lane < T::size(); ++lane) values.vector[lane] = number();
      }
    }
    auto const found = scarp::lanes::square_roots(asked[0], asked[1]);
    auto const check = [&](Scalar square, Scalar root, Scalar inverse) {
      auto const exact = std::sqrt(static_cast<long double>(square));
      CHECK(std::abs(static_cast<Scalar>(root / exact - 1)) <= bound);
      CHECK(std::abs(static_cast<Scalar>(inverse * exact - 1)) <= bound);
    };
    for (std::size_t k = 0; k < 2; ++k) {
      if constexpr (std::is_same_v<T, Scalar>) {
        check(asked[k], found[k].value, found[k].inverse);
      } else {
        for (std::size_t lane = 0; lane < T::size(); ++lane)
          check(asked[k][lane], found[k].value[lane], found[k].inverse[lane]);
      }
    }
  }
}

}  // namespace

TEST_CASE_TEMPLATE("square roots and their inverses err by two epsilons at most, in lanes as in single numbers", T,
                   double, scarp::lanes::Pack<double>, scarp::lanes::Pack<float>) {
  check_square_roots<T>();
}

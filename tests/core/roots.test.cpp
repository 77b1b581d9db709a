// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/roots.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "scarp/core/random.hpp"

namespace {

/// Largest errors of root and inverse in units of the last place, over random numbers of all magnitudes whose square is a
/// normal number.
template <class T, class Scalar>
void check_roots(Scalar most_units) {
  constexpr Scalar unit = std::numeric_limits<Scalar>::epsilon();
  double const range = 0.95 * std::log(static_cast<double>(std::numeric_limits<Scalar>::max()));
  scarp::Random random(7);
  for (int draw = 0; draw < 20'000; ++draw) {
    auto const number = [&] { return static_cast<Scalar>(std::exp(range * random.uniform(-1.0, 1.0))); };
    Scalar const a = number();
    Scalar const b = number();
    auto const found = scarp::lanes::roots(T(a), T(b));
    auto const lane = [](T const& values) {
      if constexpr (std::is_same_v<T, Scalar>) {
        return values;
      } else {
        return values[T::size() - 1];
      }
    };
    for (auto const& [root, asked] : {std::pair{found[0], a}, std::pair{found[1], b}}) {
      auto const exact = std::sqrt(static_cast<long double>(asked));
      CHECK(std::abs(static_cast<Scalar>(lane(root.value) / exact - 1)) <= most_units * unit);
      CHECK(std::abs(static_cast<Scalar>(lane(root.inverse) * exact - 1)) <= most_units * unit);
    }
  }
}

}  // namespace

TEST_CASE("roots and their inverses err by two units in the last place, in lanes as in single numbers") {
  check_roots<scarp::lanes::Pack<double>>(2.0);
  check_roots<scarp::lanes::Pack<float>>(2.0F);
  check_roots<double>(2.0);
}

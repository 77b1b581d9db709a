// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <cmath>

#include "scarp/simd/pack.hpp"
#include "scarp/simd/select.hpp"

TEST_CASE_TEMPLATE("selection and bounds act lane by lane and keep what is not a number", T, float, double,
                   scarp::lanes::Pack<float>, scarp::lanes::Pack<double>) {
  // Exact: nothing is rounded.
  T const one(1), two(2), none(std::nanf(""));
  auto const all = [](auto condition) {
    if constexpr (std::is_same_v<decltype(condition), bool>) {
      return condition;
    } else {
      return all_of(condition);
    }
  };
  CHECK(all(scarp::lanes::select(one < two, one, two) == one));
  CHECK(all(scarp::lanes::select(two < one, one, two) == two));
  CHECK(all(scarp::lanes::at_least(one, two) == two));
  CHECK(all(scarp::lanes::at_least(two, one) == two));
  CHECK(all(scarp::lanes::at_most(one, two) == one));
  CHECK(all(scarp::lanes::at_most(two, one) == one));
  T const low = scarp::lanes::at_least(none, one);
  T const high = scarp::lanes::at_most(none, one);
  CHECK(all(low != low));
  CHECK(all(high != high));
}

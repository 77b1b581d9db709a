// SPDX-License-Identifier: BSL-1.0
#include "scarp/budget/budget_part.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "support/approx.hpp"
#include "support/refusals.hpp"

TEST_CASE(
    "a sensitivity run's part is the difference over a size, either way, and outside where the run has no answer") {
  auto const part = scarp::Sensitivity{.own = -14.0, .other = -15.0, .size = 25.0, .bound = 0.05}.part("mesh", "place");
  CHECK(part.name == "mesh");
  CHECK(part.value == samples::Approx(0.04).epsilon(1e-15));  // 1 m of 25 m
  CHECK(part.is_within());
  CHECK((scarp::Sensitivity{-15.0, -14.0, 25.0, 0.05}.part("mesh", "place")).value == part.value);
  CHECK_FALSE((scarp::Sensitivity{-14.0, -15.5, 25.0, 0.05}.part("mesh", "place")).is_within());
  double const nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE((scarp::Sensitivity{-14.0, nan, 25.0, 0.05}.part("mesh", "place")).is_within());
  CHECK_REFUSED((scarp::Sensitivity{-14.0, -15.0, 0.0, 0.05}.part("mesh", "place")), "size", "is 0");
}

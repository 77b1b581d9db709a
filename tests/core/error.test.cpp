// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/error.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

#include "support/refusals.hpp"

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("a refusal carries the formatted text and is an invalid argument") {
  CHECK_THROWS_WITH_AS(scarp::reject("region {} is unknown (the mesh has {}): choose one of them", 7, 3),
                       "region 7 is unknown (the mesh has 3): choose one of them", scarp::InputError);
  CHECK_THROWS_AS(scarp::reject("nothing to say"), std::invalid_argument);
}

TEST_CASE("an accepted number comes back unchanged") {
  double const smallest = std::numeric_limits<double>::denorm_min();
  CHECK(scarp::require_positive("thickness", smallest) == smallest);
  CHECK(scarp::require_not_negative("friction", 0.0) == 0.0);
  CHECK(scarp::require_finite("depth", -3.5) == -3.5);
}

TEST_CASE("zero is not positive but not negative either") {
  CHECK_REFUSED(scarp::require_positive("thickness", 0.0), "thickness is 0");
  CHECK_NOTHROW(scarp::require_not_negative("thickness", 0.0));
}

TEST_CASE("negative numbers are refused by name and value") {
  CHECK_THROWS_WITH_AS(scarp::require_positive("thickness", -0.5),
                       "thickness is -0.5 (it must be finite and above zero): give a positive number",
                       scarp::InputError);
  CHECK_THROWS_WITH_AS(scarp::require_not_negative("friction", -0.25),
                       "friction is -0.25 (it must be finite and not negative): give zero or a positive number",
                       scarp::InputError);
}

TEST_CASE("a number outside of its range is refused, its ends are not") {
  for (double const value : {0.99, 2.01, infinity, -infinity, not_a_number})
    CHECK_REFUSED(scarp::require_between("damping", value, 1.0, 2.0), fmt::format("damping is {}", value), "1 and 2");
  CHECK(scarp::require_between("damping", 1.0, 1.0, 2.0) == 1.0);
  CHECK(scarp::require_between("damping", 2.0, 1.0, 2.0) == 2.0);
  CHECK_REFUSED(scarp::require_at_least("steps", 2, 3), "steps is 2", "at least 3");
  CHECK(scarp::require_at_least("steps", 3, 3) == 3);
}

TEST_CASE("infinity and NaN are refused everywhere") {
  for (double const value : {infinity, -infinity, not_a_number}) {
    CAPTURE(value);
    CHECK_REFUSED(scarp::require_positive("depth", value), fmt::format("depth is {}", value));
    CHECK_REFUSED(scarp::require_not_negative("depth", value), fmt::format("depth is {}", value));
    CHECK_REFUSED(scarp::require_finite("depth", value), fmt::format("depth is {}", value));
  }
}

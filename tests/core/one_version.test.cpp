// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/one_version.hpp"

#include <doctest/doctest.h>

using scarp::detail::version_number;

static_assert(version_number("12.34.5") == 12034);
static_assert(version_number("12.34.67") == version_number("12.34.5"));
static_assert(version_number("0.2.0") == 2);
static_assert(version_number("1.0") == 1000);

TEST_CASE("functions know the version that they come from") {
  CHECK(scarp::detail::version_of_functions() == version_number(scarp::version));
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/nan_max.hpp"

#include <doctest/doctest.h>

#include <limits>

TEST_CASE("of two errors the larger one is worse, and none is as bad as one that is no number") {
  CHECK(scarp::nan_max(1.0, 2.0) == 2.0);
  CHECK(scarp::nan_max(2.0, 1.0) == 2.0);
  double const none = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(scarp::nan_max(none, 2.0)));
  CHECK(std::isnan(scarp::nan_max(2.0, none)));
}

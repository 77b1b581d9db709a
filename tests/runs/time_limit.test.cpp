// SPDX-License-Identifier: BSL-1.0
#include "scarp/run/time_limit.hpp"

#include <doctest/doctest.h>

TEST_CASE("a time limit counts from the moment that it is told, such as the start of a program") {
  auto const now = std::chrono::steady_clock::now();
  CHECK(scarp::TimeLimit(5.0, now - std::chrono::seconds(9)).wants_stop());
  CHECK_FALSE(scarp::TimeLimit(1e6, now - std::chrono::seconds(9)).wants_stop());
  CHECK_FALSE(scarp::TimeLimit(5.0).wants_stop());
  CHECK_FALSE(scarp::TimeLimit(0.0, now - std::chrono::seconds(9)).wants_stop());
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/error.hpp"

#include <doctest/doctest.h>

#include <vector>

TEST_CASE("the elements of a range are listed with what stands between them") {
  std::vector<double> const numbers{1.0, 2.5, -3.0};
  CHECK(scarp::listed(numbers) == "1, 2.5, -3");
  CHECK(scarp::listed(numbers, " ", "<{:.1f}>") == "<1.0> <2.5> <-3.0>");
  CHECK(scarp::listed(std::vector<int>{7}) == "7");
  CHECK(scarp::listed(std::vector<int>{}).empty());
}

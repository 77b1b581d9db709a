// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/shared_history.hpp"

#include <doctest/doctest.h>

using History = scarp::SharedHistory<int>;

TEST_CASE("a copy of a history shares its rows and goes its own way") {
  History common;
  CHECK(common.empty());
  for (int row = 0; row < 3; ++row) common.push_back(row);
  History one = common;
  CHECK(one == common);
  History other = common;
  one.push_back(10);
  other.push_back(20);
  CHECK(common.rows() == std::vector<int>{0, 1, 2});
  CHECK(one.rows() == std::vector<int>{0, 1, 2, 10});
  CHECK(other.rows() == std::vector<int>{0, 1, 2, 20});
  CHECK(one.continues(common));
  CHECK(other.continues(common));
  CHECK_FALSE(one.continues(other));
  one = common;
  CHECK(one == common);
  one = std::move(other);
  CHECK(one.back() == 20);
}

TEST_CASE("a history of a million rows comes and goes without filling the stack") {
  History history;
  for (int row = 0; row < 1'000'000; ++row) history.push_back(row);
  History const half = history;
  history = History();
  CHECK(history.size() == 0);
  CHECK(half.size() == 1'000'000);
}

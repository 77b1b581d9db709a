// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/status.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string_view>

using scarp::Reason;
using scarp::Status;
using scarp::Verdict;

TEST_CASE("only ok and fluid answers may be committed, whatever the reason says") {
  for (Reason const reason : {Reason::none, Reason::no_contacts, Reason::not_finite}) {
    CHECK(Verdict{Status::ok, reason}.acceptable());
    CHECK(Verdict{Status::fluid, reason}.acceptable());
    CHECK_FALSE(Verdict{Status::not_converged, reason}.acceptable());
    CHECK_FALSE(Verdict{Status::failed, reason}.acceptable());
  }
}

TEST_CASE("a verdict that nobody filled in is ok for no reason") {
  CHECK(Verdict{} == Verdict{Status::ok, Reason::none});
  CHECK(Verdict{} != Verdict{Status::ok, Reason::no_contacts});
  CHECK(Verdict{} != Verdict{Status::failed, Reason::none});
}

TEST_CASE("every status and every reason has a name of its own") {
  std::set<std::string_view> names;
  int count = 0;
  for (Status const status : {Status::ok, Status::fluid, Status::not_converged, Status::failed}) {
    names.insert(name(status));
    ++count;
  }
  int const last_reason = static_cast<int>(Reason::interrupted);
  for (int k = 0; k <= last_reason; ++k) {
    if (k == 10) continue;  // a former reason; checkpoints hold the numbers of the others
    names.insert(name(static_cast<Reason>(k)));
    ++count;
  }
  CHECK(static_cast<int>(names.size()) == count);
  CHECK(names.count("unknown") == 0);
}

TEST_CASE("a value outside the enumeration is called unknown") {
  CHECK(name(static_cast<Status>(200)) == "unknown");
  CHECK(name(static_cast<Reason>(200)) == "unknown");
}

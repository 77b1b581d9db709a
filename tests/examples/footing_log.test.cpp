// SPDX-License-Identifier: BSL-1.0
#include "../../examples/fault_rupture/footing_log.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

struct NothingMoves {};

}  // namespace

TEST_CASE("a log of a footing without an end or a profile is refused") {
  samples::ScratchFolder const folder;
  for (double const to : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    CHECK_REFUSED(fault_rupture::FootingLog(folder.path(), NothingMoves{}, to, 10, 1.0), "end of the load");
  CHECK_REFUSED(fault_rupture::FootingLog(folder.path(), NothingMoves{}, 1.0, 0, 1.0),
                "profiles up to the end of the load is 0");
}

TEST_CASE("the pressed share of a base is that of its area") {
  auto const pressure = fault_rupture::base_pressure(
      {.base = {{.area = 1.0, .pressure = 5e3}, {.area = 2.0, .pressure = -1e3}, {.area = 1.0, .pressure = 2e3}}});
  CHECK(pressure.least == -1e3);
  CHECK(pressure.largest == 5e3);
  CHECK(pressure.pressed == 0.5);
}

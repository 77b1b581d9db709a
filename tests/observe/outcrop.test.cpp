// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/outcrop.hpp"

#include <doctest/doctest.h>

#include "support/approx.hpp"

namespace {

/// Level to x = -10, then falling by 0.2 per metre to 2 m, gently falling to 2.1 m at x = 10.
std::vector<scarp::SurfacePoint> bent_profile() {
  std::vector<scarp::SurfacePoint> profile;
  for (double const x : {-20.0, -15.0, -10.0, 0.0, 10.0}) {
    double const settlement = x <= -10.0 ? 0.0 : x <= 0.0 ? 0.2 * (x + 10.0) : 2.0 + 0.01 * x;
    profile.push_back({x, x, settlement});
  }
  return profile;
}

constexpr double round_off = 1e-14;

}  // namespace

TEST_CASE("the outcrop lies where the line of the steepest part meets the undeformed surface") {
  auto const found = scarp::outcrop(bent_profile(), 2.1);
  CHECK(found.outcrop_x == samples::Approx(-10.0).epsilon(round_off));
  CHECK(found.steepest_x == samples::Approx(-5.0).epsilon(round_off));
  CHECK(found.width == samples::Approx(10.5).epsilon(round_off));  // analytic: 2.1 m at 0.2 per metre
}

TEST_CASE("a steepest part within the slope projects back to the surface") {
  // Analytic: 0.5 per metre between (1, 0.3) and (2, 0.8) meets zero at 1 - 0.3/0.5 = 0.4.
  auto const found = scarp::outcrop({{0.0, 0.0, 0.1}, {1.0, 1.0, 0.3}, {2.0, 2.0, 0.8}, {4.0, 4.0, 1.0}}, 1.0);
  CHECK(found.outcrop_x == samples::Approx(0.4).epsilon(round_off));
  CHECK(found.steepest_x == 1.5);
  CHECK(found.width == samples::Approx(2.0).epsilon(round_off));
}

TEST_CASE("a surface that has not settled, or only rises, has no outcrop") {
  for (double const slope : {0.0, -0.1}) {
    auto const found = scarp::outcrop({{0.0, 0.0, 0.0}, {1.0, 1.0, slope}, {2.0, 2.0, 2.0 * slope}}, 1.0);
    CHECK(std::isnan(found.outcrop_x));
    CHECK(std::isnan(found.steepest_x));
    CHECK(std::isnan(found.width));
  }
}

TEST_CASE("a gap is no part of a slope") {
  // The steepest joined part falls by 0.1 per metre; across the gap it would be 0.9.
  std::vector<scarp::SurfacePoint> const profile{
      {0.0, 0.0, 0.0}, {1.0, 1.0, 0.05}, {2.0, 2.0, 0.95, false}, {3.0, 3.0, 1.05}};
  auto const found = scarp::outcrop(profile, 1.0);
  CHECK(found.steepest_x == 2.5);
  CHECK(found.width == samples::Approx(10.0).epsilon(round_off));
}

TEST_CASE("a reverse fault comes out where the normal one does that goes the other way") {
  auto risen = bent_profile();
  for (auto& point : risen) point.settlement *= -1.0;
  auto const down = scarp::outcrop(bent_profile(), 2.1);
  auto const up = scarp::outcrop(risen, -2.1);
  CHECK(up.outcrop_x == down.outcrop_x);
  CHECK(up.steepest_x == down.steepest_x);
  CHECK(up.width == down.width);
}

TEST_CASE("what both walls do is no part of the outcrop") {
  auto moved = bent_profile();
  for (auto& point : moved) point.settlement += 5.0;
  auto const found = scarp::outcrop(moved, {.foot = 5.0, .hanging = 7.1});
  CHECK(found.outcrop_x == samples::Approx(-10.0).epsilon(round_off));
  CHECK(found.width == samples::Approx(10.5).epsilon(round_off));
}

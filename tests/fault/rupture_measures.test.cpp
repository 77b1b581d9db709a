// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/rupture_measures.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "support/approx.hpp"

namespace {

constexpr double round_off = 1e-12;
constexpr double depth = 25.0;

using Profile = std::vector<scarp::SurfacePoint>;

/// A place every 2.5 m from -50 to 25 m.
template <class Settlement>
Profile profile_of(Settlement const& settlement) {
  Profile profile;
  for (int k = -20; k <= 10; ++k) profile.push_back({2.5 * k, 2.5 * k, settlement(2.5 * k)});
  return profile;
}

/// From 0 at -20 m linearly to 1 at 0.
double scarp_at(double x) { return x <= -20.0 ? 0.0 : x >= 0.0 ? 1.0 : (x + 20.0) / 20.0; }

/// Level to x = -10, then falling by 0.2 per metre to 2 m, gently falling to 2.1 m at x = 10.
std::vector<scarp::SurfacePoint> bent_profile() {
  std::vector<scarp::SurfacePoint> profile;
  for (double const x : {-20.0, -15.0, -10.0, 0.0, 10.0}) {
    double const settlement = x <= -10.0 ? 0.0 : x <= 0.0 ? 0.2 * (x + 10.0) : 2.0 + 0.01 * x;
    profile.push_back({x, x, settlement});
  }
  return profile;
}

}  // namespace

TEST_CASE("the shares of a linear scarp lie where its line passes them") {
  auto const found = scarp::rupture_measures(profile_of([](double x) { return 2.0 * scarp_at(x); }),
                                             {.tip = 0.0, .hanging = 2.0}, depth);
  // Analytic: 20 m long.
  CHECK(found.surface_x05 == samples::Approx(-19.0).epsilon(round_off));
  CHECK(found.surface_x50 == samples::Approx(-10.0).epsilon(round_off));
  CHECK(found.surface_x95 == samples::Approx(-1.0).epsilon(round_off));
  CHECK(found.surface_slope_max == samples::Approx(0.1).epsilon(round_off));
  CHECK(found.rupture_dip == samples::Approx(std::atan(2.5)).epsilon(round_off));
  CHECK(found.largest_share == 1.0);
  CHECK(found.outcrop_x == samples::Approx(-20.0).epsilon(round_off));
  CHECK(found.outcrop_width == samples::Approx(20.0).epsilon(round_off));
}

TEST_CASE("one steep facet does not move the places that a share has passed") {
  // The same scarp with a step of 0.3 of the offset inside one facet near its end: the outcrop jumps to it, x50 stays.
  auto const stepped = [](double x) { return x < -2.5 ? 0.7 * scarp_at(x) / 0.875 : 1.0; };
  auto const found = scarp::rupture_measures(profile_of(stepped), {.hanging = 1.0}, depth);
  CHECK(found.outcrop_x > -12.0);
  CHECK(found.surface_x05 == samples::Approx(-20.0 + 20.0 * 0.05 / 0.8).epsilon(round_off));
  CHECK(found.surface_x50 == samples::Approx(-20.0 + 20.0 * 0.5 / 0.8).epsilon(round_off));
}

TEST_CASE("normal and reverse faults and those that move both walls are alike") {
  auto const normal = scarp::rupture_measures(profile_of(scarp_at), {.tip = -1.0, .hanging = 1.0}, depth);
  auto const same = [&](scarp::RuptureMeasures const& other, double slope) {
    for (auto const measure : {&scarp::RuptureMeasures::surface_x05, &scarp::RuptureMeasures::surface_x50,
                               &scarp::RuptureMeasures::surface_x95, &scarp::RuptureMeasures::rupture_dip,
                               &scarp::RuptureMeasures::outcrop_x, &scarp::RuptureMeasures::outcrop_width}) {
      CHECK(other.*measure == samples::Approx(normal.*measure).epsilon(round_off));
    }
    CHECK(other.surface_slope_max == samples::Approx(slope).epsilon(round_off));
  };
  same(scarp::rupture_measures(profile_of([](double x) { return -3.0 * scarp_at(x); }), {.tip = -1.0, .hanging = -3.0},
                               depth),
       0.15);
  same(scarp::rupture_measures(profile_of([](double x) { return scarp_at(x) - 0.5; }),
                               {.tip = -1.0, .foot = -0.5, .hanging = 0.5}, depth),
       0.05);
}

TEST_CASE("in a graben the main scarp is the first passage, and its share says how deep it is") {
  // Down to 1.6 of the throw between both scarps, back to 1 at 15 m.
  auto const graben = [](double x) { return x <= 5.0 ? 1.6 * scarp_at(x) : x <= 15.0 ? 1.6 - 0.06 * (x - 5.0) : 1.0; };
  auto const found = scarp::rupture_measures(profile_of(graben), {.hanging = 1.0}, depth);
  CHECK(found.surface_x50 == samples::Approx(-20.0 + 20.0 * 0.5 / 1.6).epsilon(round_off));
  CHECK(found.surface_x95 == samples::Approx(-20.0 + 20.0 * 0.95 / 1.6).epsilon(round_off));
  CHECK(found.largest_share == 1.6);
}

TEST_CASE("a middle line that leans over the hanging wall dips by more than a right angle") {
  auto const found = scarp::rupture_measures(profile_of(scarp_at), {.tip = -35.0, .hanging = 1.0}, depth);
  CHECK(found.rupture_dip ==
        samples::Approx(0.75 * std::numbers::pi).epsilon(round_off));  // 25 m up, 25 m to the right
}

TEST_CASE("a share that is passed in a gap, before the profile begins or nowhere has no place") {
  Profile const gap{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.1}, {3.0, 3.0, 0.9, false}, {4.0, 4.0, 1.0}};
  auto const found = scarp::rupture_measures(gap, {.hanging = 1.0}, depth);
  CHECK(found.surface_x05 == samples::Approx(0.5).epsilon(round_off));
  CHECK(std::isnan(found.surface_x50));
  CHECK(std::isnan(found.rupture_dip));
  CHECK(found.surface_x95 == samples::Approx(3.5).epsilon(round_off));
  CHECK(found.surface_slope_max == samples::Approx(0.1).epsilon(round_off));  // across the gap 0.4
  auto const late = scarp::rupture_measures({{0.0, 0.0, 0.2}, {1.0, 1.0, 0.7}}, {.hanging = 1.0}, depth);
  CHECK(std::isnan(late.surface_x05));
  CHECK(late.surface_x50 == samples::Approx(0.6).epsilon(round_off));
  CHECK(std::isnan(late.surface_x95));
  for (auto const& nothing : {scarp::rupture_measures({}, {.hanging = 1.0}, depth),
                              scarp::rupture_measures({{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}, {}, depth)}) {
    CHECK(std::isnan(nothing.surface_x05));
    CHECK(std::isnan(nothing.surface_x50));
    CHECK(std::isnan(nothing.largest_share));
    CHECK(std::isnan(nothing.outcrop_x));
  }
}

TEST_CASE("the outcrop lies where the line of the steepest part meets the undeformed surface") {
  auto const found = scarp::outcrop(bent_profile(), {.hanging = 2.1});
  CHECK(found.outcrop_x == samples::Approx(-10.0).epsilon(round_off));
  CHECK(found.steepest_x == samples::Approx(-5.0).epsilon(round_off));
  CHECK(found.width == samples::Approx(10.5).epsilon(round_off));  // analytic: 2.1 m at 0.2 per metre
}

TEST_CASE("a steepest part within the slope projects back to the surface") {
  // Analytic: 0.5 per metre between (1, 0.3) and (2, 0.8) meets zero at 1 - 0.3/0.5 = 0.4.
  auto const found =
      scarp::outcrop({{0.0, 0.0, 0.1}, {1.0, 1.0, 0.3}, {2.0, 2.0, 0.8}, {4.0, 4.0, 1.0}}, {.hanging = 1.0});
  CHECK(found.outcrop_x == samples::Approx(0.4).epsilon(round_off));
  CHECK(found.steepest_x == 1.5);
  CHECK(found.width == samples::Approx(2.0).epsilon(round_off));
}

TEST_CASE("a surface that has not settled, or only rises, has no outcrop") {
  for (double const slope : {0.0, -0.1}) {
    auto const found = scarp::outcrop({{0.0, 0.0, 0.0}, {1.0, 1.0, slope}, {2.0, 2.0, 2.0 * slope}}, {.hanging = 1.0});
    CHECK(std::isnan(found.outcrop_x));
    CHECK(std::isnan(found.steepest_x));
    CHECK(std::isnan(found.width));
  }
}

TEST_CASE("a gap is no part of a slope") {
  // The steepest joined part falls by 0.1 per metre; across the gap it would be 0.9.
  std::vector<scarp::SurfacePoint> const profile{
      {0.0, 0.0, 0.0}, {1.0, 1.0, 0.05}, {2.0, 2.0, 0.95, false}, {3.0, 3.0, 1.05}};
  auto const found = scarp::outcrop(profile, {.hanging = 1.0});
  CHECK(found.steepest_x == 2.5);
  CHECK(found.width == samples::Approx(10.0).epsilon(round_off));
}

TEST_CASE("a reverse fault comes out where the normal one does that goes the other way") {
  auto risen = bent_profile();
  for (auto& point : risen) point.settlement *= -1.0;
  auto const down = scarp::outcrop(bent_profile(), {.hanging = 2.1});
  auto const up = scarp::outcrop(risen, {.hanging = -2.1});
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

// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/outcrop.hpp"

#include <doctest/doctest.h>

#include "approx.hpp"
#include "scarp/mesh/rectangle_mesh.hpp"

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

TEST_CASE("settlement is linear between the points and constant beyond them") {
  auto const profile = bent_profile();
  CHECK(scarp::settlement_at(profile, -100.0) == 0.0);
  CHECK(scarp::settlement_at(profile, -12.0) == 0.0);
  CHECK(scarp::settlement_at(profile, -5.0) == samples::Approx(1.0).epsilon(round_off));
  CHECK(scarp::settlement_at(profile, 0.0) == samples::Approx(2.0).epsilon(round_off));
  CHECK(scarp::settlement_at(profile, 5.0) == samples::Approx(2.05).epsilon(round_off));
  CHECK(scarp::settlement_at(profile, 100.0) == samples::Approx(2.1).epsilon(round_off));
}

TEST_CASE("the profile runs from left to right and tells where each node was and is") {
  auto const mesh = scarp::RectangleMesh{.width = 4.0, .height = 1.0, .columns = 4, .rows = 1}.generate();
  auto positions = mesh.nodes;
  for (auto& position : positions) position += scarp::Vector<2>(0.25, -0.5 * position(0));
  auto nodes = scarp::boundary_nodes(mesh, "top");
  std::reverse(nodes.begin(), nodes.end());
  auto const profile = scarp::surface_profile(mesh, positions, nodes);
  REQUIRE(profile.size() == 5);
  for (std::size_t k = 0; k < profile.size(); ++k) {
    auto const x = static_cast<double>(k);
    CHECK(profile[k].x_initial == x);
    CHECK(profile[k].x == x + 0.25);
    CHECK(profile[k].settlement == 0.5 * x);
  }
}

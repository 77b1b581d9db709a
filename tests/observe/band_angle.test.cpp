// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/band_angle.hpp"

#include <doctest/doctest.h>

#include "support/approx.hpp"

namespace {

/// A band through the origin in ground that is strained a hundredth of it.
std::vector<scarp::StrainedPlace> band(double angle) {
  std::vector<scarp::StrainedPlace> places;
  scarp::Vector<2> const along(std::cos(angle), std::sin(angle));
  for (int i = -20; i <= 20; ++i) {
    for (int j = -20; j <= 20; ++j) places.push_back({{0.5 * i, 0.5 * j}, 1e-3, 1.0});
    places.push_back({0.5 * i * along, 0.1, 1.0});
  }
  return places;
}

}  // namespace

TEST_CASE("a band's angle is found at every inclination, whatever the ground around it strains") {
  // The square of ground around it is as wide along all axes: it takes nothing from the axis, by symmetry.
  for (double const angle : {0.1, 0.8, 1.2, std::numbers::pi / 2.0, 2.0, 3.0})
    CHECK(scarp::band_angle(band(angle)) == samples::Approx(angle).epsilon(1e-10));
}

TEST_CASE("a horizontal band lies at zero") {
  CHECK(std::abs(std::sin(scarp::band_angle(band(0.0)))) < 1e-10);
  CHECK(scarp::band_angle(band(0.0)) < std::numbers::pi);
}

TEST_CASE("without strain, or with as much along all axes, there is no angle") {
  CHECK(std::isnan(scarp::band_angle({})));
  CHECK(std::isnan(scarp::band_angle({{{1.0, 2.0}, 0.0, 1.0}})));
  CHECK(std::isnan(scarp::band_angle(
      {{{1.0, 0.0}, 0.1, 1.0}, {{-1.0, 0.0}, 0.1, 1.0}, {{0.0, 1.0}, 0.1, 1.0}, {{0.0, -1.0}, 0.1, 1.0}})));
}

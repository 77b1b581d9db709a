// SPDX-License-Identifier: BSL-1.0
#include "scarp/points/neighbour_mean.hpp"

#include <doctest/doctest.h>

#include <array>

#include "scarp/core/executor.hpp"
#include "scarp/points/nonlocal.hpp"
#include "support/approx.hpp"

TEST_CASE("weights are volumes times Wendland's function of the distance") {
  std::vector<scarp::Site<2>> where(4);
  for (std::size_t k = 0; k < where.size(); ++k) {
    where[k].position = {0.0, 2.0 * std::array{0.0, 0.25, 0.5, 1.0}[k]};
  }
  scarp::NeighbourMean const mean =
      scarp::neighbour_mean<2>(where, std::vector{1.0, 2.0, 3.0, 4.0}, std::vector(4, 2.0));
  // Analytic: (1 - s)^4 (4 s + 1) is 1, 81/128 and 3/16 at s = 0, 1/4 and 1/2, and nothing at s = 1.
  std::array const weights{1.0, 2.0 * 81.0 / 128.0, 3.0 * 3.0 / 16.0};
  REQUIRE(mean.of(0).size() == weights.size());
  for (std::size_t k = 0; k < weights.size(); ++k) {
    CHECK(mean.of(0)[k].weight == samples::Approx(weights[k] / (weights[0] + weights[1] + weights[2])).epsilon(1e-14));
  }
  std::vector const values{128.0, 0.0, 0.0, 7.0};
  std::vector const ones(4, 1.0);
  auto const mean_of = [&](int point, std::vector<double> const& factors) {
    return mean.mean(point, std::span<double const>(values), factors);
  };
  CHECK(mean_of(0, ones) == samples::Approx(128.0 / (1.0 + 81.0 / 64.0 + 9.0 / 16.0)).epsilon(1e-14));
  CHECK(mean_of(0, {3.0, 2.0, 1.0, 5.0}) ==
        samples::Approx(3.0 * 128.0 / (3.0 + 81.0 / 32.0 + 9.0 / 16.0)).epsilon(1e-14));
  scarp::SerialExecutor serial;
  auto const all = mean.means(values, ones, serial);
  REQUIRE(all.size() == 4);
  for (int point = 0; point < 4; ++point) CHECK(all[static_cast<std::size_t>(point)] == mean_of(point, ones));
}

TEST_CASE("means are local where every point sees itself only") {
  std::vector<scarp::Site<2>> where(2);
  where[1].position = {1.0, 0.0};
  std::vector const volumes{1.0, 1.0};
  CHECK(scarp::neighbour_mean<2>(where, volumes, std::vector{0.0, 0.5}).is_local());
  CHECK_FALSE(scarp::neighbour_mean<2>(where, volumes, std::vector{0.0, 1.5}).is_local());
  CHECK(scarp::NeighbourMean{}.is_local());
  CHECK(scarp::NeighbourMean{}.size() == 0);
}

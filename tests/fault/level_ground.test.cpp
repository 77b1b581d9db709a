// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/level_ground.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/dem/gradings.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/homogenise/balance.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"

using Grains = samples::Ellipses;

TEST_CASE("ground that once carried a quarter more has its overburden at every depth, and a higher K0") {
  auto const law = samples::study_law();
  scarp::LevelGround<scarp::EllipseGrading> ground;
  ground.cloud = {.grading = {.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75},
                  .grains = 60,
                  .density = 2650.0,
                  .thickness = 0.2,
                  .seed = 1};
  auto const plain = ground.make<Grains>(law, {3.0, 12.0});
  ground.preload = 1.25;
  auto const preloaded = ground.make<Grains>(law, {3.0, 12.0});
  for (std::size_t k = 0; k < 2; ++k) {
    auto const before = scarp::balance(plain.packings[k], law).stress;
    auto const after = scarp::balance(preloaded.packings[k], law).stress;
    CHECK(after(1, 1) == samples::Approx(-ground.overburden(plain.depths[k])).epsilon(2e-3));
    CHECK(after(0, 0) / after(1, 1) > 1.05 * before(0, 0) / before(1, 1));
  }
  for (double const wrong : {0.99, std::numeric_limits<double>::quiet_NaN()}) {
    ground.preload = wrong;
    CHECK_THROWS_WITH_AS(ground.make<Grains>(law, {3.0}), doctest::Contains("preload"), scarp::InputError);
  }
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/rve/level_ground.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/dem/gradings.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/shape/ellipse.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

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
  ground.overconsolidation_ratio = 1.25;
  auto const preloaded = ground.make<Grains>(law, {3.0, 12.0});
  for (std::size_t k = 0; k < 2; ++k) {
    auto const before = scarp::balance(plain.packings[k], law).stress;
    auto const after = scarp::balance(preloaded.packings[k], law).stress;
    CHECK(after(1, 1) == samples::Approx(-ground.overburden(plain.depths[k])).epsilon(2e-3));
    CHECK(after(0, 0) / after(1, 1) > 1.05 * before(0, 0) / before(1, 1));
  }
}

namespace {

/// Of few grains, which come to rest in a moment.
scarp::LevelGround<scarp::EllipseGrading> small_ground() {
  scarp::LevelGround<scarp::EllipseGrading> ground;
  ground.cloud = {.grading = {.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75},
                  .grains = 30,
                  .density = 2650.0,
                  .thickness = 0.2,
                  .seed = 1};
  return ground;
}

}  // namespace

TEST_CASE("settings of level ground that cannot be are refused") {
  auto const law = samples::study_law();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  auto const refused = [&](auto change, std::vector<double> depths, std::initializer_list<std::string_view> parts) {
    auto ground = small_ground();
    change(ground);
    CHECK(samples::message_of([&] { ground.make<Grains>(law, depths); }) == samples::Naming(parts));
  };
  auto const none = [](auto&) {};
  refused(none, {}, {"no depths are given"});
  refused(none, {3.0, nan}, {"depth of a packing", "nan"});
  refused([](auto& g) { g.overconsolidation_ratio = 0.99; }, {3.0}, {"overconsolidation ratio", "0.99"});
  refused([](auto& g) { g.overconsolidation_ratio = nan; }, {3.0}, {"overconsolidation ratio", "nan"});
  refused([](auto& g) { g.unit_weight = -1.0; }, {3.0}, {"unit weight", "-1"});
  refused([](auto& g) { g.surcharge = nan; }, {3.0}, {"surcharge", "nan"});
  refused(none, {3.0, -37.5}, {"37.5 m above the ground surface"});
  refused(none, {3.0, 3000.0}, {"4.704e+07 Pa", "3000 m below the surface", "lengths in metres"});
  refused([](auto& g) { g.preparation.pressure = 5e3; }, {0.0, 3.0}, {"prepared at 5000 Pa", "carries 4000 Pa"});
}

TEST_CASE("a preparation of which one member is given keeps the others of level ground") {
  scarp::LevelGround<scarp::EllipseGrading> const loose{.preparation = {.preparation_friction = 0.3}};
  CHECK(loose.preparation.pressure == 2e3);
  CHECK(loose.preparation.consolidation.unbalanced_tolerance ==
        scarp::IsotropicPreparation{}.consolidation.unbalanced_tolerance);
  scarp::LevelGround<scarp::EllipseGrading> const light{.preparation = {.pressure = 500.0}};
  CHECK(light.preparation.preparation_friction == 0.08);
}

TEST_CASE("packings that do not come to their stress end the preparation in words") {
  auto const law = samples::study_law();
  auto const ended = [&](auto change, std::initializer_list<std::string_view> parts) {
    auto ground = small_ground();
    change(ground);
    CHECK(samples::message_of<scarp::PreparationError>([&] { ground.make<Grains>(law, {3.0}); }) ==
          samples::Naming(parts));
  };
  ended([](auto& g) { g.preparation.consolidation.max_steps = 1; }, {"did not reach 2000 Pa"});
  ended([](auto& g) { g.compression.servo.max_steps = 1; }, {"stopped at 51040 Pa"});
}

TEST_CASE("packings below a water table carry what the water leaves") {
  auto ground = small_ground();
  ground.buoyancy = {.water_table = 3.0, .lift = 6e3};
  auto const law = samples::study_law();
  auto const made = ground.make<Grains>(law, {3.0, 6.0});
  for (std::size_t k = 0; k < 2; ++k) {
    double const depth = made.depths[k];
    double const expected = ground.surcharge + ground.unit_weight * depth - (depth > 3.0 ? 6e3 * (depth - 3.0) : 0.0);
    CHECK(-scarp::balance(made.packings[k], law).stress(1, 1) ==
          samples::Approx(expected).epsilon(2e-3));  // servo 1e-3
  }
}

TEST_CASE("level ground that would float is rejected") {
  auto ground = small_ground();
  ground.buoyancy = {.water_table = 0.0, .lift = 1.01 * ground.unit_weight};
  CHECK_REFUSED(ground.make<Grains>(samples::study_law(), {3.0, 6.0}), "the ground would float");
}

TEST_CASE("depths are the same by their overburden, in models of any size") {
  // A model in a centrifuge: a hundred times the weight, a hundredth of the depths.
  auto ground = small_ground();
  ground.unit_weight *= 1e4;
  ground.surcharge = 4e3;
  auto const made = ground.make<Grains>(samples::study_law(), {3e-4, 3.008e-4, 3.008e-4 * (1.0 + 1e-12)});
  CHECK(made.packings.size() == 2);  // 0.8 micrometres and 0.03 % of the overburden apart, and two that are the same
}

// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <numbers>

#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/fault/frictional_footing.hpp"
#include "scarp/fault/tied_footing.hpp"
#include "support/approx.hpp"

namespace {

using Newton = scarp::QuasiNewton<>;
using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;
template <class Structure>
using Scene = scarp::FaultScene<Soil, Structure, Newton>;
using Tied = scarp::CohesiveBond<scarp::LinearFrictional>;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Structure>
Scene<Structure> scene(Structure const& structure, double cohesion) {
  Scene<Structure> made;
  scarp::Strength const strength{.cohesion = cohesion, .friction = 0.54, .dilation = 0.11};
  made.soil = {scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25),
               {strength},
               {.surcharge = made.surcharge, .unit_weight = made.unit_weight, .k0 = 0.4}};
  made.ground.layer.size = 5.0;
  made.structure = structure;
  made.throw_to = 0.25;
  made.solver.tolerance = 1e-10;
  made.solver.rule.exact.floor = 1e-4;
  made.stepping.max_displacement_gradient = 0.02;
  return made;
}

struct Outcome {
  scarp::FootingMotion placed;
  scarp::FootingMotion ruptured;
};

template <class Structure>
Outcome run(Scene<Structure> const& scene) {
  scarp::SerialExecutor executor;
  scarp::NoObserver no_observer;
  auto problem = scene.problem(executor);
  REQUIRE(scene.settle(problem, no_observer).verdict.acceptable());
  auto placing = scene;  // steps of the throw are no steps of the load that is placed
  placing.stepping.first = placing.stepping.smallest = placing.stepping.largest = 0.2;
  REQUIRE(placing.place(problem, no_observer).verdict.acceptable());
  Outcome outcome{scene.structure.motion(problem), {}};
  auto const report = scene.rupture(problem, no_observer);
  REQUIRE(report.verdict.acceptable());
  CHECK(report.load == 0.25);
  outcome.ruptured = scene.structure.motion(problem);
  return outcome;
}

constexpr double weight = 91e3 * 10.0;
constexpr double noticeable = 0.01 * 0.25 / 10.0;  // [rad]: a hundredth of the throw over the width

}  // namespace

TEST_CASE("a rigid footing with friction stands through a rupture: no tension, its weight carried to 1e-8") {
  scarp::FrictionalFooting<> footing;
  footing.interface = {.normal_stiffness = 1e8, .tangential_stiffness = 1e8, .friction = 0.5};
  auto const outcome = run(scene(footing, 1e3));
  for (auto const& motion : {outcome.placed, outcome.ruptured}) {
    CHECK(scarp::support(motion) == samples::Approx(weight).epsilon(1e-8));
    for (auto const& point : motion.base) {
      CHECK(point.pressure >= 0.0);
      CHECK(std::abs(point.shear) <= 0.5 * point.pressure * (1.0 + 1e-12));
    }
  }
  // The hanging wall is on the right: the footing's left edge is beyond the rupture.
  CHECK(outcome.ruptured.tilt > outcome.placed.tilt + noticeable);
  CHECK(outcome.ruptured.settlement > outcome.placed.settlement);
}

TEST_CASE("a tied footing stands through a rupture with its weight carried to 1e-8") {
  auto const outcome = run(scene(scarp::TiedFooting{}, 1e3));
  for (auto const& motion : {outcome.placed, outcome.ruptured}) {
    CHECK(scarp::support(motion) == samples::Approx(weight).epsilon(1e-8));
    for (auto const& point : motion.base) CHECK(point.shear == -point.stress.x());  // to the left on a level base
  }
  CHECK(outcome.ruptured.tilt > outcome.placed.tilt + noticeable);
}

TEST_CASE("a footing of 1e3 to 1e6 times the soil's stiffness and a rigid one converge to one another") {
  // Soil that does not yield; the rigid footing is tied by an interface of 1e11 Pa/m where the soil below has E/B =
  // 2.5e6.
  constexpr double strong = 1e9;
  scarp::FrictionalFooting<Tied> rigid;
  rigid.interface = {{.normal_stiffness = 1e11, .tangential_stiffness = 1e11, .friction = 0.0}, infinity, infinity};
  // Round-off of places, 1e-14 m: times the interface on 10 m over a first load of 45 kN 2e-7; times a block of 2.5e13
  // Pa and a cell's 0.5 m over the reactions 3e-8.
  auto const tilt_of = [](auto made) {
    made.solver.tolerance = 1e-6;
    return run(made).ruptured.tilt;
  };
  double const limit = tilt_of(scene(rigid, strong));
  std::vector<double> tilts;
  for (double const contrast : {1e3, 1e4, 1e5, 1e6}) {
    scarp::TiedFooting footing;
    footing.block = scarp::LinearElastic<2>::from_young_poisson(contrast * 25e6, 0.25);
    tilts.push_back(tilt_of(scene(footing, strong)));
    MESSAGE("stiffness contrast " << contrast << ": tilt " << tilts.back() << ", " << tilts.back() / limit - 1.0
                                  << " from rigid");
    // The rigid footing meets the ground at Gauss points through springs, the block at nodes: 5e-4.
    CHECK(std::abs(tilts.back() / limit - 1.0) < 1e-3);
  }
  CHECK(std::abs(tilts[3] - tilts[2]) < 1e-5 * limit);
  CHECK(std::abs(tilts[2] - tilts[1]) < std::abs(tilts[1] - tilts[0]));
}

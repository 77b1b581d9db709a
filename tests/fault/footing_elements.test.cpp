// SPDX-License-Identifier: BSL-1.0
// Footings on a mesh of quadratic elements, whose facets have nodes in their middles.
#include <doctest/doctest.h>

#include "scarp/element/quad8.hpp"
#include "scarp/fault/frictional_footing.hpp"
#include "scarp/fault/tied_footing.hpp"
#include "scarp/observe/observers.hpp"
#include "support/approx.hpp"

namespace {

using Newton = scarp::QuasiNewton<>;
using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;

/// While a footing is placed the ground carries the share of its weight that is there.
template <class Structure>
struct Placing : scarp::NeverStops {
  Structure structure;
  int steps = 0;

  explicit Placing(Structure placed) : structure(std::move(placed)) {}
  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    ++steps;
    double const weight = structure.footing.bearing * structure.footing.width;
    double const carried = scarp::support(structure.motion(problem, report.load));
    CHECK(std::abs(carried - (1.0 + report.load) * weight) < 1e-6 * weight);
  }
};

/// Tilt that a small throw gives a footing on elastic ground; what carries it must be its weight.
template <class Element, class Structure>
double tilt(Structure const& structure) {
  scarp::FaultScene<Soil, Structure, Newton, scarp::StructuredGround<Element>> scene;
  scene.soil = Soil::from_young_poisson(25e6, 0.25, {scene.surcharge, scene.unit_weight, 0.4});
  scene.ground.layer.size = 5.0;
  scene.structure = structure;
  scene.throw_to = 0.05;
  scene.solver.tolerance = 1e-9;
  scene.stepping.max_displacement_gradient = 0.02;
  scarp::SerialExecutor executor;
  scarp::NoObserver no_observer;
  auto problem = scene.problem(executor);
  REQUIRE(scene.settle(problem, no_observer).verdict.acceptable());
  Placing<Structure> placing(structure);
  REQUIRE(scene.place(problem, placing).verdict.acceptable());
  CHECK(placing.steps > 1);
  double const placed = structure.motion(problem).tilt;
  REQUIRE(scene.rupture(problem, no_observer).verdict.acceptable());
  auto const motion = structure.motion(problem);
  double const weight = structure.footing.bearing * structure.footing.width;
  CHECK(scarp::support(motion) == samples::Approx(weight).epsilon(1e-6));
  return motion.tilt - placed;
}

}  // namespace

TEST_CASE("footings on quadratic elements tilt as on linear ones and are carried by the ground") {
  scarp::FrictionalFooting<> rigid;
  rigid.interface = {.normal_stiffness = 1e8, .tangential_stiffness = 1e8, .friction = 0.5};
  double const sticking = tilt<scarp::Quad8>(scarp::TiedFooting{});
  double const frictional = tilt<scarp::Quad8>(rigid);
  CHECK(sticking > 0.0);
  // The same settlements below both: a tenth for what the base lets slip.
  CHECK(frictional == samples::Approx(sticking).epsilon(0.1));
  // Linear triangles of 5 m: the surface's slope to a few per cent, see tests/fault/grounds.test.cpp.
  CHECK(tilt<scarp::Tri3>(rigid) == samples::Approx(frictional).epsilon(0.1));
}

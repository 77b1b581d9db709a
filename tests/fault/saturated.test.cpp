// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/saturated.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/fault/frictional_footing.hpp"
#include "scarp/fault/tied_footing.hpp"
#include "scarp/mesh/facets.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::NoObserver;
using scarp::NoStructure;
using scarp::RuptureTimes;
using scarp::Saturated;
using scarp::TiedFooting;
using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;

constexpr double depth = 25.0, void_ratio = 0.7, young = 25e6;

using Frictional = scarp::FrictionalFooting<scarp::LinearFrictional>;

/// Dry ground that is as light as if water stood in it.
template <class Structure>
struct Lifted : Structure {
  double water_table = 0.0;
  scarp::Buoyancy buoyancy() const { return {water_table, scarp::Water{}.lift(void_ratio)}; }
};

/// Sand on a coarse mesh; throw_to, water_table [m]
template <class Structure>
scarp::FaultScene<Soil, Structure> scene(double throw_to, double water_table = 0.0) {
  constexpr double degree = std::numbers::pi / 180.0;
  scarp::FaultScene<Soil, Structure> made;
  made.ground.layer.size = 5.0;
  if constexpr (requires { made.structure.water_table; }) made.structure.water_table = water_table;
  made.soil = {scarp::IsotropicElasticity::from_young_poisson(young, 0.25),
               {{.cohesion = 1e3, .friction = 30.8 * degree, .dilation = 6.6 * degree}},
               {made.surcharge, made.unit_weight, 0.4, scarp::detail::buoyancy_of(made.structure)}};
  made.solver.tolerance = 1e-6;
  made.throw_to = throw_to;
  return made;
}

template <class Structure>
auto wet(double throw_to, RuptureTimes const& times, double water_table = 0.0) {
  auto made = scene<Saturated<Structure>>(throw_to, water_table);
  made.structure.flow = scarp::KozenyCarman::of_conductivity(1e-4, void_ratio);
  made.structure.void_ratio = void_ratio;
  made.structure.shear_modulus = young / 2.5;
  made.structure.times = times;
  return made;
}

/// A problem, and how its stages ended.
template <class SceneType>
struct Run {
  scarp::SerialExecutor serial{};
  SceneType scene;
  decltype(std::declval<SceneType>().problem(serial)) problem;

  explicit Run(SceneType made) : scene(std::move(made)), problem(scene.problem(serial)) {
    NoObserver none;
    REQUIRE(scene.settle(problem, none).verdict.acceptable());
    REQUIRE(scene.place(problem, none).verdict.acceptable());
    REQUIRE(scene.rupture(problem, none).verdict.acceptable());
  }
  void rest() {
    NoObserver none;
    REQUIRE(scene.rest(problem, none).verdict.acceptable());
  }
  auto const& water() const {
    using Water = decltype(scene.structure.field(problem.discretisation(), 1.0));
    return problem.template attached<Water>();
  }
  double area() const {
    return scarp::region_area(problem.discretisation().mesh(), "soil", problem.grid().positions());
  }
};

}  // namespace

TEST_CASE("a rupture slow enough for the water is that of dry ground which is lifted alike") {
  double water_table = 0.0;
  SUBCASE("water table at the surface") {}
  SUBCASE("in the ground, between the lines of the mesh") { water_table = 8.0; }
  Run const dry(scene<Lifted<NoStructure>>(0.1, water_table));
  Run const slow(wet<NoStructure>(0.1, {.rupture = 1e12}, water_table));
  auto const moved = [](auto const& run) { return run.problem.grid().positions(); };
  auto const one = moved(dry);
  auto const other = moved(slow);
  double largest = 0.0;
  for (std::size_t node = 0; node < one.size(); ++node) largest = std::max(largest, (one[node] - other[node]).norm());
  CHECK(largest < 1e-4 * 0.1);  // steps differ; measured
  CHECK(slow.water().vapour() == 0.0);
  if (water_table > 0.0) return;  // what has grown above the table is empty
  // Grains keep their volume, and so does water: what the ground has grown by has come in.
  double const grown =
      slow.area() - scarp::region_area(slow.problem.discretisation().mesh(), "soil", slow.problem.grid().nodes());
  CHECK(-slow.water().expelled() == samples::Approx(grown).epsilon(1e-4));
}

TEST_CASE("ground with a water table begins in balance, and above the table its pores are empty") {
  constexpr double table = 8.0;
  auto made = wet<NoStructure>(0.3, {.rupture = 1.0}, table);
  CHECK(made.overburden(5.0) == samples::Approx(made.surcharge + 15.68e3 * 5.0));
  CHECK(made.overburden(20.0) ==
        samples::Approx(made.surcharge + 15.68e3 * 20.0 - 9.81e3 / (1.0 + void_ratio) * (20.0 - table)));
  scarp::SerialExecutor serial;
  auto problem = made.problem(serial);
  NoObserver none;
  REQUIRE(made.settle(problem, none).verdict.acceptable());
  // Also at the table, which crosses elements.
  auto const settled = problem.grid().positions();
  for (std::size_t node = 0; node < settled.size(); ++node)
    CHECK((settled[node] - problem.grid().nodes()[node]).norm() < 1e-9);
  REQUIRE(made.rupture(problem, none).verdict.acceptable());
  auto const pressures = problem.attached<decltype(made.structure.field(problem.discretisation(), 1.0))>().pressures();
  CHECK(std::ranges::max(pressures) > 20e3);
  for (std::size_t node = 0; node < pressures.size(); ++node)
    if (problem.grid().nodes()[node].y() >= depth - table) CHECK(pressures[node] == 0.0);
}

TEST_CASE("a fast rupture leaves suction and pressure, which drain while the bedrock rests") {
  RuptureTimes const times{.rupture = 1.0, .drainage = 1e6};
  double water_table = 0.0;
  SUBCASE("without water on the ground") {}
  SUBCASE("with it") { water_table = -3.0; }
  Run fast(wet<NoStructure>(0.3, times, water_table));
  auto const begun = fast.problem.grid().positions();
  double const before = fast.area();
  auto const pressures = fast.water().pressures();
  auto const [least, most] = std::ranges::minmax(pressures);
  CHECK(least < -50e3);
  CHECK(most > 20e3);
  double const thrown = fast.water().time();
  double const expelled = fast.water().expelled();
  fast.rest();
  auto const rested = fast.water().pressures();
  for (double const pressure : rested) CHECK(std::abs(pressure) < 1.0);
  CHECK(fast.water().time() - thrown == samples::Approx(1e6).epsilon(1e-6));
  // The bedrock has not moved, and water has come in as the ground grew.
  for (auto const& name : {"bottom", "left", "right"})
    for (int const node : fast.problem.grid().boundary_nodes(name)) {
      auto const at = static_cast<std::size_t>(node);
      CHECK((fast.problem.grid().positions()[at] - begun[at]).norm() < 1e-12);
    }
  // But for what the water itself grows by as its pressure goes: a thousandth of it.
  CHECK(expelled - fast.water().expelled() == samples::Approx(fast.area() - before).epsilon(1e-2));
}

TEST_CASE("a footing has no water, stands drained before the fault moves, and settles by what drains") {
  Run fast(wet<TiedFooting>(0.02, {.rupture = 1.0}));
  auto const& grid = fast.problem.discretisation();
  auto const pressures = fast.water().pressures();
  for (std::size_t node = 0; node < pressures.size(); ++node)
    if (grid.nodes()[node].y() >= depth) CHECK(pressures[node] == 0.0);
  CHECK(fast.water().expelled() > 0.1);  // squeezed out below the footing
  CHECK(fast.scene.end() == fast.scene.throw_to);
}

TEST_CASE(
    "a footing on a frictional base stands on wet ground as on dry ground that is lifted alike, and feels its water") {
  auto const put = [](auto made) {
    made.structure.footing = {.bearing = 91e3};
    made.structure.interface = {.normal_stiffness = 1e8, .tangential_stiffness = 1e8, .friction = 0.5};
    return made;
  };
  double water_table = 0.0;
  SUBCASE("water table at the surface") {}
  SUBCASE("in the ground") { water_table = 8.0; }
  Run const dry(put(scene<Lifted<Frictional>>(0.1, water_table)));
  Run const slow(put(wet<Frictional>(0.1, {.rupture = 1e12}, water_table)));
  auto const one = dry.scene.structure.motion(dry.problem);
  auto const other = slow.scene.structure.motion(slow.problem);
  CHECK(other.settlement == samples::Approx(one.settlement).epsilon(1e-3));  // steps differ; measured
  CHECK(std::abs(other.tilt - one.tilt) < 1e-3 * std::abs(one.tilt));
  CHECK(scarp::support(other) == samples::Approx(91e3 * 10.0).epsilon(1e-6));

  Run fast(put(wet<Frictional>(0.1, {.rupture = 1.0, .drainage = 1e6}, water_table)));
  auto const thrown = fast.scene.structure.motion(fast.problem);
  CHECK(std::abs(thrown.tilt - one.tilt) > 1e-2 * std::abs(one.tilt));
  fast.rest();
  auto const rested = fast.scene.structure.motion(fast.problem);
  CHECK(scarp::support(rested) == samples::Approx(91e3 * 10.0).epsilon(1e-6));
  CHECK(std::abs(rested.settlement - thrown.settlement) > 1e-5);
  for (double const pressure : fast.water().pressures()) CHECK(std::abs(pressure) < 1.0);
}

TEST_CASE("a footing without weight yet stays where it is when irregular ground moves away from it") {
  // Elements that the water table crosses have another lateral stress than their neighbours, which moves the surface.
  auto made = wet<Frictional>(0.01, {.rupture = 1e12}, 2.0);
  made.ground.layer.size = 2.5;
  made.ground.layer.jitter = 0.3;
  made.structure.footing = {.bearing = 91e3};
  made.structure.interface = {.normal_stiffness = 1e8, .tangential_stiffness = 1e8, .friction = 0.5};
  Run const run(made);
  CHECK(scarp::support(run.scene.structure.motion(run.problem)) == samples::Approx(91e3 * 10.0).epsilon(1e-6));
}

TEST_CASE("times of a rupture follow the throw, and those without sense are refused") {
  RuptureTimes const times{.rupture = 2.0, .drainage = 2e3};
  auto const clock = times.clock(-1.0, 0.5, 1e6);
  CHECK(clock(-1.0) == -1e6);
  CHECK(clock(0.0) == 0.0);
  CHECK(clock(0.25) == samples::Approx(1.0).epsilon(1e-14));
  CHECK(clock(0.5) == 2.0);
  CHECK(clock(times.end(0.5)) == samples::Approx(2002.0).epsilon(1e-14));
  int knots = 0;
  for (double knot = 0.5; knot < times.end(0.5); knot = clock.next_knot(knot)) ++knots;
  CHECK(knots == 32);  // five decades from 0.02 s, six a decade, the first, and a minute
  bool has_minute = false;
  for (double knot = 0.5; knot < times.end(0.5); knot = clock.next_knot(knot))
    has_minute = has_minute || clock(knot) == 62.0;
  CHECK(has_minute);
  CHECK(RuptureTimes{}.end(0.5) == 0.5);
  CHECK(times.end(0.5) < 0.5001);  // 0.5 with four digits
  CHECK_REFUSED(wet<NoStructure>(0.1, {.rupture = 0.0}).problem(*std::make_unique<scarp::SerialExecutor>()),
                "time of the rupture");
  auto wrong = wet<NoStructure>(0.1, {});
  wrong.structure.void_ratio = -0.5;
  CHECK_REFUSED(wrong.problem(*std::make_unique<scarp::SerialExecutor>()), "void ratio of saturated ground is -0.5");
  CHECK_REFUSED(wet<NoStructure>(0.1, {.drainage = -1.0}).problem(*std::make_unique<scarp::SerialExecutor>()),
                "time of drainage");
}

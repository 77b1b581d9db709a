// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/rupture_survey.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "scarp/fault/ground_at_rest.hpp"
#include "support/approx.hpp"
#include "support/ground.hpp"

namespace {

using Positions = std::vector<scarp::Vector<2>>;

struct Run {
  scarp::Mesh<scarp::Tri3> mesh;
  Positions rest;
  Positions now;
  scarp::FaultOffset fault;
};

/// forgotten: part of the weight that the ground was not prepared for, so that it settles before the fault moves
Run run(double forgotten) {
  auto scene = samples::elastic_ground();
  scene.soil = samples::ElasticSoil::from_young_poisson(
      20e6, 0.3, {scene.surcharge, (1.0 - forgotten) * scene.unit_weight, samples::k0});
  scene.throw_to = 0.02;
  scarp::SerialExecutor serial;
  scarp::NoObserver no_observer;
  auto problem = scene.problem(serial);
  REQUIRE(scene.settle(problem, no_observer).verdict == scarp::Verdict{});
  auto const rest = scarp::ground_at_rest(problem);
  REQUIRE(scene.rupture(problem, no_observer).verdict == scarp::Verdict{});
  auto const& grid = problem.discretisation();
  return {grid.mesh(), rest.of(grid.nodes()), grid.positions(), {.tip = scene.fault.tip, .hanging = scene.throw_to}};
}

Run const& elastic() {
  static Run const made = run(0.0);
  return made;
}

scarp::RuptureSurvey survey(Run const& of) { return scarp::rupture_survey(of.mesh, of.rest, of.now, of.fault); }

/// In the order of the mesh's own numbers.
void check_alike(scarp::RuptureSurvey const& a, scarp::RuptureSurvey const& b, double tolerance) {
  CHECK(a.surface.surface_x05 == samples::Approx(b.surface.surface_x05).epsilon(tolerance));
  CHECK(a.surface.surface_x50 == samples::Approx(b.surface.surface_x50).epsilon(tolerance));
  CHECK(a.surface.surface_x95 == samples::Approx(b.surface.surface_x95).epsilon(tolerance));
  CHECK(a.surface.surface_slope_max == samples::Approx(b.surface.surface_slope_max).epsilon(tolerance));
  CHECK(a.surface.rupture_dip == samples::Approx(b.surface.rupture_dip).epsilon(tolerance));
  CHECK(a.surface.outcrop_x == samples::Approx(b.surface.outcrop_x).epsilon(tolerance));
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(a.bands[k].band_x50 == samples::Approx(b.bands[k].band_x50).epsilon(tolerance));
    CHECK(a.bands[k].band_width == samples::Approx(b.bands[k].band_width).epsilon(tolerance));
    CHECK(a.bands[k].band_dip == samples::Approx(b.bands[k].band_dip).epsilon(tolerance));
  }
}

}  // namespace

TEST_CASE("the offset of a fault spreads on its way through elastic ground") {
  auto const found = survey(elastic());
  CHECK(found.depth == 25.0);
  CHECK(found.surface.surface_x05 < found.surface.surface_x50);
  CHECK(found.surface.surface_x50 < found.surface.surface_x95);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(found.bands[k].height == 25.0 * (static_cast<double>(k) + 1.0) / 4.0);
    double const above = k < 2 ? found.bands[k + 1].band_width : found.surface.surface_x95 - found.surface.surface_x05;
    CHECK(found.bands[k].band_width < above);
    CHECK(found.bands[k].band_across < found.bands[k].band_width);
  }
  // Along bedrock the share rises by 0.1 a metre about the tip, over two cells of 5 m. The next nodes lie half a cell
  // above: at a tenth of that their share, anything from 0 to 1, moves the half by at most 0.1 x 0.5 / (0.9 x 0.1) m.
  auto const low = scarp::band_at_level(elastic().mesh, elastic().rest, elastic().now, elastic().fault, 0.25, 0.125);
  CHECK(std::abs(low.band_x50) < 0.56);
}

TEST_CASE("ground that settles before the fault moves shows the same rupture") {
  // Elastic ground: what came before changes the answer only through the changed shape, here 1.6 mm in 25 m; from the
  // initial mesh the same settlement is 7 % of the throw.
  auto const settled = run(0.008);
  double const before = settled.mesh.nodes[0].y() - settled.rest[0].y();
  CHECK(before == 0.0);  // bedrock
  auto const profile = scarp::surface_profile(settled.mesh, settled.mesh.nodes, settled.rest);
  CHECK(scarp::settlement_at(profile, -20.0) > 0.05 * settled.fault.hanging);
  check_alike(survey(settled), survey(elastic()), 2e-3);
  auto const from_mesh = scarp::rupture_survey(settled.mesh, settled.mesh.nodes, settled.now, settled.fault);
  CHECK(std::abs(from_mesh.surface.surface_x05 - survey(elastic()).surface.surface_x05) > 1.0);
}

TEST_CASE(
    "the same ground moved the other way, as by a reverse fault, or carried along with both walls, ruptures alike") {
  auto reverse = elastic();
  auto both = elastic();
  for (std::size_t n = 0; n < reverse.now.size(); ++n) {
    reverse.now[n] = 2.0 * reverse.rest[n] - reverse.now[n];
    both.now[n].y() -= 0.25;
  }
  reverse.fault.hanging = -reverse.fault.hanging;
  both.fault.foot += 0.25;
  both.fault.hanging += 0.25;
  // Analytic: shares of the offset are the same numbers; round-off of coordinates of 50 m over an offset of 0.02 m.
  check_alike(survey(reverse), survey(elastic()), 1e-9);
  check_alike(survey(both), survey(elastic()), 1e-9);
}

TEST_CASE("a fault that has not moved has no rupture") {
  auto still = elastic();
  still.now = still.rest;
  auto const found = survey(still);
  CHECK(std::isnan(found.surface.surface_x50));
  CHECK(std::isnan(found.surface.rupture_dip));
  CHECK(found.surface.surface_slope_max == 0.0);
  CHECK(std::isnan(found.bands[1].band_x50));
  CHECK(std::isnan(found.bands[1].band_dip));
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/field_series.hpp"

#include <doctest/doctest.h>

#include "scarp/bvp/constraints.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/hex8.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/make_problem.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;

/// Tells the depth of a point's start, read from its stress; only of points in the upper half of an element.
struct UpperDepth : Soil {
  scarp::Quantities quantities(Soil::State const& state) const {
    double const depth = -state.stress(1) / initial.unit_weight;
    double const within = depth - std::floor(depth);
    if (within > 0.5) return {};
    return {{"depth", depth}};
  }
};

}  // namespace

TEST_CASE("an element's stress is the mean over its points, and so is a quantity over the points that have it") {
  // A column of three cells of 1 m with four points each, in a stress that grows with depth.
  constexpr double weight = 10e3;
  scarp::SerialExecutor serial;
  scarp::Discretisation<scarp::Quad4> grid(
      scarp::BoxMesh<scarp::Quad4>{.lengths = {1.0, 3.0}, .cells = {1, 3}}.generate());
  scarp::Constraints constraints(grid.mesh());
  UpperDepth const soil{Soil::from_young_poisson(1e6, 0.3, {.unit_weight = weight, .k0 = 0.5})};
  auto const region = grid.mesh().regions.front();
  auto problem = scarp::make_problem(grid, 3.0, boost::hana::make_tuple(scarp::Region{region, soil}),
                                     std::move(constraints), scarp::LoadHistory(), serial);
  auto const fields = scarp::detail::element_fields(problem);
  REQUIRE(fields.stress.size() == 9);
  for (std::size_t e = 0; e < 3; ++e) {
    double const middle = 2.5 - static_cast<double>(e);  // cells from the bottom up
    CHECK(std::abs(fields.stress[3 * e + 1] + weight * middle) < 1e-9 * weight);
    CHECK(std::abs(fields.stress[3 * e] + 0.5 * weight * middle) < 1e-9 * weight);
    // Gauss' points lie 1/(2 sqrt 3) above and below the middle.
    CHECK(std::abs(fields.quantities.at("depth")[e] - (middle - 0.5 / std::sqrt(3.0))) < 1e-9);
    CHECK(std::abs(fields.volumetric[e]) < 1e-14);
    CHECK(fields.status[e] == 0);
  }
}

TEST_CASE("in space strains are those of the whole tensor, and stress has its six components") {
  using Ground = scarp::LinearElastic<3, scarp::GeostaticStress<3>>;
  scarp::SerialExecutor serial;
  scarp::Discretisation<scarp::Hex8> grid(scarp::BoxMesh<scarp::Hex8>{.cells = {1, 2, 1}}.generate());
  scarp::Constraints constraints(grid.mesh());
  // Analytic: stretches 1.1 along x and 0.9 along z of all nodes.
  auto const& nodes = grid.mesh().nodes;
  for (int n = 0; n < static_cast<int>(nodes.size()); ++n) {
    auto const& place = nodes[static_cast<std::size_t>(n)];
    constraints.move(n, 0, 0.1 * place.x());
    constraints.fix(n, 1);
    constraints.move(n, 2, -0.1 * place.z());
  }
  grid.commit(constraints.displacement(1.0));
  auto const soil = Ground::from_young_poisson(1e6, 0.3, {.surcharge = 1e3, .k0 = 0.5});
  auto const region = grid.mesh().regions.front();
  auto problem = scarp::make_problem(grid, 1.0, boost::hana::make_tuple(scarp::Region{region, soil}),
                                     std::move(constraints), scarp::LoadHistory(), serial);
  auto const fields = scarp::detail::element_fields(problem);
  REQUIRE(fields.stress.size() == 12);
  CHECK(fields.quantities.empty());
  for (std::size_t e = 0; e < 2; ++e) {
    CHECK(std::abs(fields.volumetric[e] + std::log(1.1 * 0.9)) < 1e-12);
    CHECK(std::abs(fields.deviatoric[e] - std::log(1.1 / 0.9)) < 1e-12);
    CHECK(std::abs(fields.stress[6 * e + 1] + 500.0) < 1e-9);
    CHECK(std::abs(fields.stress[6 * e + 2] + 1e3) < 1e-9);
  }
}

namespace {

/// Tells a quantity with a name.
struct Named : Soil {
  scarp::Quantities quantities(Soil::State const&) const { return {{"status", 1.0}}; }
};
struct Volumetric : Soil {
  scarp::Quantities quantities(Soil::State const&) const { return {{"volumetric_strain", 1.0}}; }
};

}  // namespace

TEST_CASE_TEMPLATE("an own quantity with the name of a field is refused before a file is written", Own, Named,
                   Volumetric) {
  scarp::SerialExecutor serial;
  scarp::Discretisation<scarp::Quad4> grid(
      scarp::BoxMesh<scarp::Quad4>{.lengths = {1.0, 1.0}, .cells = {1, 1}}.generate());
  scarp::Constraints constraints(grid.mesh());
  auto const region = grid.mesh().regions.front();
  auto problem = scarp::make_problem(
      grid, 1.0, boost::hana::make_tuple(scarp::Region{region, Own{Soil::from_young_poisson(1e6, 0.3)}}),
      std::move(constraints), scarp::LoadHistory(), serial);
  samples::ScratchFolder const folder;
  scarp::FieldSeries series(folder.path(), {.to = 1.0, .count = 2});
  auto const name = std::is_same_v<Own, Named> ? "'status'" : "'volumetric_strain'";
  CHECK_REFUSED(series.attempted(problem, {}), "own quantity", name);
  CHECK_FALSE(std::filesystem::exists(folder / "fields/step_0000.vtu"));
}

TEST_CASE("a series takes the states at its loads although these are sums of steps, beyond its end too") {
  scarp::LoadSchedule schedule{1.0, 10};
  for (int step = 0; step <= 40; ++step) CHECK(schedule.takes(0.05 * step) == (step % 2 == 0));  // 0.30000000000000004
  scarp::LoadSchedule sums{1.0, 50};
  double load = 0.0;
  for (int step = 0; step <= 50; ++step, load += 0.02) CHECK(sums.takes(load));
  CHECK_FALSE(sums.takes(std::nan("")));
  scarp::LoadSchedule coarse{1.0, 2};
  CHECK(coarse.takes(0.0));
  CHECK(coarse.takes(0.7));
  CHECK_FALSE(coarse.takes(0.9));
  CHECK(coarse.takes(1.2));  // the end is behind it
  CHECK_FALSE(coarse.takes(1.3));
}

TEST_CASE("a series' end, number of frames and unit that cannot be are refused") {
  samples::ScratchFolder const folder;
  auto const series = [&](double to, int frames, double unit) {
    return scarp::FieldSeries(folder.path(), {.to = to, .count = frames, .unit = unit});
  };
  CHECK_REFUSED(series(0.0, 4, 25.0), "end of the load is 0");
  CHECK_REFUSED(series(-1.0, -4, 25.0), "end of the load is -1");
  CHECK_REFUSED(series(1.0, 0, 25.0), "up to the end of the load is 0");
  CHECK_REFUSED(series(1.0, 4, std::nan("")), "unit of the load is nan");
}

TEST_CASE("a series belongs to one run") {
  scarp::SerialExecutor serial;
  scarp::Discretisation<scarp::Quad4> grid(
      scarp::BoxMesh<scarp::Quad4>{.lengths = {1.0, 1.0}, .cells = {1, 1}}.generate());
  scarp::Constraints constraints(grid.mesh());
  auto const region = grid.mesh().regions.front();
  auto problem =
      scarp::make_problem(grid, 1.0, boost::hana::make_tuple(scarp::Region{region, Soil::from_young_poisson(1e6, 0.3)}),
                          std::move(constraints), scarp::LoadHistory(), serial);
  samples::ScratchFolder const folder;
  scarp::FieldSeries series(folder.path(), {.to = 1.0, .count = 2});
  scarp::StepReport report;
  for (double const load : {0.0, 0.5, 1.0}) {
    report.load = load;
    series.attempted(problem, report);
  }
  CHECK(series.last() == 1.0);
  report.load = 0.5;
  CHECK_REFUSED(series.attempted(problem, report), "reaches the load 1", "at 0.5");
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/surface_log.hpp"

#include <doctest/doctest.h>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "scarp/io/csv_reader.hpp"
#include "scarp/io/state_bits.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::content;
using samples::ScratchFolder;

/// As much of a problem as the log looks at; it sinks by hand.
struct Ground {
  scarp::Discretisation<scarp::Tri3> elements;
  scarp::Grid<2> const& grid() const { return elements; }

  void sink(double by) { elements.commit(scarp::Vector<2>(0.0, -by).replicate(elements.node_count(), 1)); }
};

Ground ground_with_footing() {
  auto mesh = scarp::FaultMesh{.size = 5.0}.generate({-15.0, -5.0});
  scarp::mark_footing_base(mesh, -10.0, 10.0);
  return {scarp::Discretisation<scarp::Tri3>(mesh)};
}

struct Row {
  double fault_throw, x_initial, x, settlement;
  int joined;
};

std::vector<Row> rows_of(std::filesystem::path const& path) {
  std::istringstream lines(content(path));
  std::string line;
  std::getline(lines, line);
  CHECK(line == "throw_over_depth,x_initial,x,settlement,joined");
  std::vector<Row> rows;
  char comma;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    Row row{};
    cells >> row.fault_throw >> comma >> row.x_initial >> comma >> row.x >> comma >> row.settlement >> comma >>
        row.joined;
    rows.push_back(row);
  }
  return rows;
}

scarp::StepReport accepted(double load) { return {.load = load}; }
scarp::StepReport refused(double load) {
  return {.load = load, .verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced}};
}

}  // namespace

TEST_CASE("settlement counts from the last accepted state before the fault moves, below a footing too") {
  ScratchFolder const folder;
  auto ground = ground_with_footing();
  scarp::SurfaceLog log(folder / "surface.csv", 1.0, 2, 10.0);
  ground.sink(0.5);
  log.attempted(ground, accepted(-1.0));  // settled
  ground.sink(0.25);
  log.attempted(ground, accepted(0.0));  // placed
  ground.sink(0.125);
  log.attempted(ground, refused(0.0));  // no state that could be one of rest
  log.attempted(ground, accepted(0.5));
  auto const rows = rows_of(folder / "surface.csv");
  auto const& mesh = ground.elements.mesh();
  std::size_t const points = scarp::surface_profile(mesh, mesh.nodes, mesh.nodes).size();
  REQUIRE(rows.size() == 2 * points);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    CHECK(rows[k].settlement == (k < points ? 0.0 : 0.125));  // binary fractions: exact
    CHECK(rows[k].fault_throw == (k < points ? 0.0 : 0.05));
    CHECK(rows[k].joined == (k % points == 0 ? 0 : 1));
  }
}

TEST_CASE("a log that is continued from a checkpoint still knows the ground at rest") {
  ScratchFolder const folder;
  auto ground = ground_with_footing();
  scarp::StateWriter saved;
  {
    scarp::SurfaceLog log(folder / "surface.csv", 1.0, 2, 1.0);
    ground.sink(0.5);
    log.attempted(ground, accepted(0.0));
    saved("log", std::as_const(log));
  }
  scarp::SurfaceLog log(folder / "surface.csv", 1.0, 2, 1.0, scarp::CsvStart::resumed);
  scarp::StateReader reader(saved.bits());
  reader("log", log);
  ground.sink(0.25);
  log.attempted(ground, accepted(1.0));
  auto const rows = rows_of(folder / "surface.csv");
  CHECK(rows.front().settlement == 0.0);
  CHECK(rows.back().settlement == 0.25);
}

TEST_CASE("a run that nobody saw at rest counts from its mesh") {
  ScratchFolder const folder;
  auto ground = ground_with_footing();
  scarp::SurfaceLog log(folder / "surface.csv", 1.0, 1, 1.0);
  ground.sink(0.5);
  log.attempted(ground, accepted(1.0));
  CHECK(rows_of(folder / "surface.csv").back().settlement == 0.5);
}

TEST_CASE("a run that stops between two profiles leaves its last state, once") {
  ScratchFolder const folder;
  auto ground = ground_with_footing();
  scarp::SurfaceLog log(folder / "surface.csv", 1.0, 2, 1.0);
  log.attempted(ground, accepted(0.0));
  std::size_t const points = rows_of(folder / "surface.csv").size();
  ground.sink(0.25);
  log.attempted(ground, accepted(0.25));  // not due
  log.ended(ground, 0.25);
  log.ended(ground, 0.25);
  auto const rows = rows_of(folder / "surface.csv");
  REQUIRE(rows.size() == 2 * points);
  CHECK(rows.back().settlement == 0.25);
  CHECK(rows.back().fault_throw == 0.25);
}

TEST_CASE("a log's end, number of profiles and unit that cannot be are refused") {
  ScratchFolder const folder;
  auto const log = [&](double to, int profiles, double unit) {
    return scarp::SurfaceLog<>(folder / "surface.csv", to, profiles, unit);
  };
  CHECK_NOTHROW(log(2.0, 4, 25.0));
  CHECK_REFUSED(log(-2.0, 4, 25.0), "end of the load is -2");
  CHECK_REFUSED(log(std::nan(""), 4, 25.0), "end of the load is nan");
  CHECK_REFUSED(log(-2.0, -4, 25.0), "end of the load is -2");
  CHECK_REFUSED(log(2.0, 0, 25.0), "up to the end of the load is 0");
  CHECK_REFUSED(log(2.0, 4, 0.0), "unit of the load is 0");
}

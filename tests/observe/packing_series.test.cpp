// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/packing_series.hpp"

#include <doctest/doctest.h>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/io/csv_reader.hpp"
#include "scarp/io/state_bits.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "support/approx.hpp"
#include "support/files.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using samples::ScratchFolder;

using Rve = scarp::DemRve<samples::Discs, scarp::SamePacking<samples::Discs>>;
using Any = scarp::AnyProvider<2>;

/// As much of a problem as the series looks at: one point.
class OnePoint {
 public:
  template <class Material>
  explicit OnePoint(Material const& material) : points_(material, std::vector<scarp::Site<2>>(1)) {}
  auto const& executor() const { return serial_; }
  auto const& points() const { return points_; }

 private:
  scarp::SerialExecutor serial_{};
  scarp::MaterialPoints<2> points_;
};

Rve sand() { return {.law = samples::study_law(), .source = {samples::consolidated<samples::Discs>(80).packing}}; }

scarp::StepReport accepted(double load) { return {.load = load}; }

std::vector<double> throws_in(std::filesystem::path const& list) { return scarp::read_csv(list).column("load"); }

}  // namespace

TEST_CASE_TEMPLATE("packings are written at the first steps that have come to the shares", Material,
                   scarp::StiffnessFloor<Rve>, Any) {
  ScratchFolder const folder;
  OnePoint const problem(Material(scarp::StiffnessFloor<Rve>{.provider = sand()}));
  scarp::PackingSeries series(folder.path(), "A", 0, 2.0, {0.0, 0.25, 0.3, 0.5, 1.0}, {8.0});
  series.attempted(problem, accepted(-1.0));
  CHECK_FALSE(std::filesystem::exists(folder / "packings"));
  series.attempted(problem, {.load = 0.0, .verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced}});
  CHECK_FALSE(std::filesystem::exists(folder / "packings"));
  for (double const load : {0.0, 0.4, 0.75, 0.9, 1.0}) series.attempted(problem, accepted(load));
  CHECK(throws_in(folder / "packings/A.csv") == std::vector<double>{0.0, 0.09375, 0.125});
  series.ended(problem, 1.0);  // written already
  CHECK(throws_in(folder / "packings/A.csv").size() == 3);
  series.ended(problem, 1.5);
  CHECK(throws_in(folder / "packings/A.csv").back() == 0.1875);

  auto const grains = scarp::read_csv(folder / "packings/A_3_grains.csv");
  auto const contacts = scarp::read_csv(folder / "packings/A_3_contacts.csv");
  auto const cell = scarp::read_csv(folder / "packings/A_3_cell.csv");
  CHECK(grains.rows() == 80);
  CHECK(grains.column("a") == grains.column("b"));
  // The normal forces' part of Love and Weber's stress along x, of what is written and of the packing itself.
  auto const from = contacts.column("x1");
  auto const to = contacts.column("x2");
  auto const force = contacts.column("normal_force");
  auto const normal = contacts.column("nx");
  double sum = 0.0;
  for (std::size_t c = 0; c < contacts.rows(); ++c) sum += force[c] * normal[c] * (to[c] - from[c]);
  double expected = 0.0;
  scarp::for_each_contact(sand().initial_state({}).packing, samples::study_law(), [&](auto const& contact) {
    expected += contact.normal_force * contact.normal()(0) * contact.branch(0);
  });
  CHECK(sum == samples::Approx(expected).epsilon(1e-9));  // numbers are written in full; round-off of places
  double const area = cell.column("a1x")[0] * cell.column("a2y")[0] - cell.column("a1y")[0] * cell.column("a2x")[0];
  CHECK(area == samples::Approx(sand().source.packing.cell.determinant()).epsilon(1e-12));
}

TEST_CASE("a series that goes on from a checkpoint has the packings before it in its list") {
  ScratchFolder const folder;
  OnePoint const problem(sand());
  scarp::StateWriter saved;
  {
    scarp::PackingSeries series(folder.path(), "B", 0, 1.0, {0.0, 0.5, 1.0}, {1.0});
    series.attempted(problem, accepted(0.0));
    saved("series", std::as_const(series));
    series.attempted(problem, accepted(0.6));  // lost with the process
  }
  scarp::PackingSeries series(folder.path(), "B", 0, 1.0, {0.0, 0.5, 1.0}, {1.0});
  scarp::StateReader reader(saved.bits());
  reader("series", series);
  series.attempted(problem, accepted(0.5));
  CHECK(throws_in(folder / "packings/B.csv") == std::vector<double>{0.0, 0.5});
}

TEST_CASE("a point without a packing leaves nothing behind") {
  ScratchFolder const folder;
  OnePoint const problem(Any(scarp::LinearElastic<2>::from_young_poisson(20e6, 0.3)));
  scarp::PackingSeries series(folder.path(), "A", 0, 1.0, {0.0, 1.0}, {1.0});
  series.attempted(problem, accepted(0.0));
  series.ended(problem, 0.5);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("shares, ends, units and points that cannot be are refused") {
  ScratchFolder const folder;
  for (auto const& shares : {std::vector{0.5, 0.5}, std::vector{-0.1}, std::vector{1.1}, std::vector{std::nan("")}})
    CHECK_REFUSED(scarp::PackingSeries(folder.path(), "A", 0, 1.0, shares, {1.0}),
                  fmt::format("share {} of the load", shares.back()));
  CHECK_REFUSED(scarp::PackingSeries(folder.path(), "A", 0, std::nan(""), {0.5}, {1.0}), "end of the load is nan");
  CHECK_REFUSED(scarp::PackingSeries(folder.path(), "A", 0, 1.0, {0.5}, {0.0}), "unit of the load is 0");
  OnePoint const problem(sand());
  for (int const point : {-1, 1}) {
    scarp::PackingSeries series(folder.path(), "A", point, 1.0, {0.0}, {1.0});
    CHECK_REFUSED(series.attempted(problem, accepted(0.0)), fmt::format("point {} is to be observed", point));
  }
}

TEST_CASE("a share is met by a load that is a sum of steps") {
  ScratchFolder const folder;
  OnePoint const problem(sand());
  scarp::PackingSeries series(folder.path(), "A", 0, 1.0, {0.0, 0.5, 1.0}, {1.0});
  double load = 0.0;  // 0.5 and 1 are met from below
  for (int step = 0; step <= 20; ++step, load += 0.05) series.attempted(problem, accepted(load));
  auto const at = scarp::CsvColumns(scarp::read_file(folder / "packings/A.csv"), "A.csv").column("load");
  REQUIRE(at.size() == 3);
  CHECK(at[1] == samples::Approx(0.5));
  CHECK(at[2] == samples::Approx(1.0));
}

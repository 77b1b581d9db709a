// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "../../examples/consolidation/column.hpp"
#include "scarp/budget/error_budget.hpp"
#include "scarp/element/quad8.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using consolidation::Column;
using samples::Approx;
using scarp::LoadStepping;
using scarp::Quad8;
using scarp::Reason;
using scarp::TimeFunction;
using Grid = scarp::DefaultGrid<Quad8>;
using Water = scarp::PoreWater<Grid, scarp::ConstantPermeability>;

Column const terzaghi;  // its load is 1 Pa, so that errors in Pa are those over the load
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr LoadStepping at_once{.first = 1.0, .smallest = 1e-6, .largest = 1.0, .max_displacement_gradient = 1.0};
constexpr LoadStepping by_error{.first = 1e-6, .smallest = 1e-9, .max_displacement_gradient = 1.0};

Grid column_grid(int rows) {
  return Grid(scarp::BoxMesh<Quad8>{.lengths = scarp::Vector<2>(1.0 / rows, 1.0), .cells = {1, rows}}.generate());
}

/// Terzaghi's water, drained at the top. clock: time factors over the load factor
Water water_in(Grid const& grid, std::optional<double> allowed, std::vector<std::pair<double, double>> clock) {
  for (auto& knot : clock) knot.second /= terzaghi.consolidation();
  scarp::Water const incompressible{.bulk_modulus = infinite};
  Water water(grid, {terzaghi.mobility * incompressible.unit_weight, incompressible},
              {.shear_modulus = terzaghi.modulus / 2.0, .clock = TimeFunction(clock), .largest_time_error = allowed});
  water.drain({"top"});
  return water;
}

scarp::Model<2> column(Grid const& grid, Water const& water, TimeFunction const& load) {
  scarp::Model model(grid);
  model.fix({"left", "right"}, 0);
  model.fix({"bottom"}, 1);
  model.surcharge({"top"}, terzaghi.load, load);
  model.material("soil", scarp::LinearElastic<2>::from_young_poisson(terzaghi.modulus, 0.0));
  model.attach(water);
  return model;
}

Water const& pores(scarp::Problem<2> const& problem) { return problem.attached<Water>(); }

/// What an observer has seen of a column that was loaded at once, at the time factors that are given.
struct Seen {
  int rows = 40;  ///< of elements
  std::vector<double> loaded{0.0};
  double from = 0.01 - 1e-9;  ///< time factor from which errors count
  double error = 0.0;         ///< largest of the pressure of a corner, over the load
  std::vector<scarp::StepReport> reports{};

  void attempted(scarp::Problem<2> const& problem, scarp::StepReport const& report) {
    reports.push_back(report);
    double const now = pores(problem).time() * terzaghi.consolidation();
    if (!report.verdict.acceptable() || now < from) return;
    auto const found = pores(problem).pressures();
    auto const& grid = problem.grid();
    for (std::size_t node = 0; node < found.size(); ++node) {
      if (grid.nodes()[node].x() != 0.0 || std::abs(std::remainder(grid.nodes()[node].y(), 1.0 / rows)) > 1e-9)
        continue;
      double exact = 0.0;
      for (double const start : loaded)
        if (now > start) exact += Column::pressure(now - start, grid.nodes()[node].y());
      error = std::max(error, std::abs(found[node] - exact));
    }
  }
  static bool wants_stop() { return false; }
};

struct Run {
  scarp::RunReport report{};
  Seen seen{};
};

/// A column of 40 elements, loaded at once at the load factor 1, which consolidates to T = 1 until the load factor 2.
Run consolidate(std::optional<double> allowed, LoadStepping const& stepping) {
  auto const grid = column_grid(Seen().rows);
  scarp::SerialExecutor serial;
  auto problem =
      column(grid, water_in(grid, allowed, {{1.0, 0.0}, {2.0, 1.0}}), TimeFunction::ramp(0.0, 1.0)).problem(serial);
  Run run;
  REQUIRE(at_once.run(scarp::QuasiNewton<>(), problem, 0.0, 1.0, run.seen).verdict.acceptable());
  CHECK(run.seen.reports.back().time_error == 0.0);  // no time has passed
  run.seen.reports.clear();
  run.report = stepping.run(scarp::QuasiNewton<>(), problem, 1.0, 2.0, run.seen);
  return run;
}

template <class State>
std::string bits_of(State const& state) {
  scarp::StateWriter writer;
  writer("state", state);
  return writer.bits();
}

}  // namespace

TEST_CASE(
    "the error of a consolidation falls as the root of that of a step, in a seventh of the steps of a uniform clock") {
  // Analytic: Terzaghi. Errors of a step of second order that are all alike leave their root to the sum of them, and
  // take steps in number as the other root.
  Run const coarse = consolidate(1e-2, by_error);
  Run const middle = consolidate(1e-3, by_error);
  Run const fine = consolidate(1e-4, by_error);
  for (Run const* run : {&coarse, &middle, &fine}) {
    MESSAGE(run->report.steps, " steps, ", run->report.refused, " refused, error ", run->seen.error);
    CHECK(run->report.verdict.acceptable());
    CHECK(run->report.refused <= 3);
    for (auto const& step : run->seen.reports) CHECK(step.verdict.acceptable() == (step.time_error <= 1.0));
  }
  CHECK(coarse.seen.error < 0.03);
  auto const order = [](double first, double second) { return std::log10(second / first); };
  CHECK(std::abs(order(middle.seen.error, coarse.seen.error) - 0.5) < 0.1);
  CHECK(std::abs(order(fine.seen.error, middle.seen.error) - 0.5) < 0.1);
  CHECK(std::abs(order(middle.report.steps, fine.report.steps) - 0.5) < 0.1);

  Run const uniform = consolidate({}, {.first = 1.0 / 400, .smallest = 1e-6, .largest = 1.0 / 400});
  MESSAGE(uniform.report.steps, " uniform steps, error ", uniform.seen.error);
  CHECK(uniform.seen.error > coarse.seen.error);
  CHECK(uniform.report.steps > 6 * coarse.report.steps);
  for (auto const& step : uniform.seen.reports) CHECK(step.time_error == 0.0);
}

TEST_CASE("a time step of too large an error is rolled back and repeated with a smaller one") {
  auto const grid = column_grid(10);
  scarp::SerialExecutor serial;
  auto problem =
      column(grid, water_in(grid, 1e-2, {{1.0, 0.0}, {2.0, 1.0}}), TimeFunction::ramp(0.0, 1.0)).problem(serial);
  Seen seen;
  scarp::QuasiNewton<> const newton;
  REQUIRE(at_once.run(newton, problem, 0.0, 1.0, seen).verdict.acceptable());
  auto const before = bits_of(pores(problem));
  auto stepping = by_error;
  stepping.first = 0.1;
  stepping.smallest = 0.09;
  auto const ended = stepping.run(newton, problem, 1.0, 2.0, seen);
  CHECK(ended.verdict == scarp::Verdict{scarp::Status::not_converged, Reason::step_too_small});
  CHECK(ended.last_failure == Reason::time_error);
  CHECK(bits_of(pores(problem)) == before);

  seen.reports.clear();
  stepping.smallest = 1e-9;
  auto const run = stepping.run(newton, problem, 1.0, 2.0, seen);
  CHECK(run.verdict.acceptable());
  CHECK(run.refused >= 1);
  for (std::size_t k = 0; k + 1 < seen.reports.size(); ++k) {
    auto const& now = seen.reports[k];
    double const share = seen.reports[k + 1].load_increment / now.load_increment;
    if (now.verdict.acceptable()) {
      CHECK(share < stepping.growth + 1e-9);
      CHECK(share < 0.9 / std::sqrt(now.time_error) + 1e-9);
    } else {
      CHECK(now.verdict.reason == Reason::time_error);
      CHECK(share == Approx(std::max(0.9 / now.time_error, 0.1)).epsilon(1e-6));
    }
  }
}

TEST_CASE("an error budget knows the residual of the water and its largest error in time") {
  auto const grid = column_grid(Seen().rows);
  scarp::SerialExecutor serial;
  // Knots of a fault scene's drainage: six in a decade.
  std::vector<std::pair<double, double>> decades{{1.0, 0.0}};
  for (int step = 0; step <= 18; ++step) decades.emplace_back(2.0 + step, std::pow(10.0, (step - 18) / 6.0));
  for (double const allowed : {infinite, 1e-2, 1e-3}) {
    auto const bound = allowed < infinite ? std::optional(allowed) : std::nullopt;
    auto problem = column(grid, water_in(grid, bound, decades), TimeFunction::ramp(0.0, 1.0)).problem(serial);
    scarp::ErrorBudget budget(problem);
    Seen seen{.from = 0.01 - 1e-9};
    scarp::Observers observers(std::ref(budget), std::ref(seen));
    REQUIRE(at_once.run(scarp::QuasiNewton<>(), problem, 0.0, 1.0, observers).verdict.acceptable());
    auto stepping = by_error;
    if (!bound) stepping.first = 1.0;
    auto const run = stepping.run(scarp::QuasiNewton<>(), problem, 1.0, 20.0, observers);
    REQUIRE(run.verdict.acceptable());
    double residual = 0.0;
    for (auto const& report : seen.reports)
      if (report.verdict.acceptable()) residual = std::max(residual, report.parts.back().value);
    auto const parts = budget.parts();
    auto const part = [&](char const* name) { return *std::ranges::find(parts, name, &scarp::BudgetPart::name); };
    MESSAGE("allowed ", allowed, ": ", run.steps, " steps, budget ", part("time").value, ", error ", seen.error);
    CHECK(part("water").value == residual);
    CHECK(part("water").is_within());
    if (bound) CHECK(part("time").value <= allowed * (1.0 + 1e-12));
    CHECK(part("time").is_within());
    CHECK(seen.error < (bound ? 0.03 : 0.06));
  }
}

TEST_CASE("a sudden load on a ground that drains is followed in small steps") {
  // Analytic: the sum of two of Terzaghi's solutions. The load doubles at T = 0.2, between steps of 1e-2.
  auto const grid = column_grid(Seen().rows);
  auto const water = water_in(grid, 1e-3, {{1.0, 0.0}, {2.0, 0.2}, {3.0, 0.2}, {4.0, 0.6}});
  TimeFunction const load({{0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}, {3.0, 2.0}});
  scarp::SerialExecutor serial;
  auto problem = column(grid, water, load).problem(serial);
  Seen seen{.loaded = {0.0, 0.2}, .from = 0.21 - 1e-9};
  scarp::QuasiNewton<> const newton;
  REQUIRE(at_once.run(newton, problem, 0.0, 1.0, seen).verdict.acceptable());
  auto const run = by_error.run(newton, problem, 1.0, 4.0, seen);
  REQUIRE(run.verdict.acceptable());
  MESSAGE(run.steps, " steps, ", run.refused, " refused, error ", seen.error);
  CHECK(seen.error < 0.015);  // one column has 0.009
  CHECK(run.refused <= 10);
  CHECK(run.steps < 400);
}

TEST_CASE("an analysis finds its time steps, whatever it begins with") {
  auto const grid = column_grid(Seen().rows);
  scarp::Analysis analysis(column(grid, water_in(grid, 1e-2, {{1.0, 0.0}, {2.0, 1.0}}), TimeFunction::ramp(0.0, 1.0)),
                           {.stepping = {.first = 0.05, .smallest = 1e-9, .largest = 0.1}, .threads = 1});
  Seen seen;
  auto const run = analysis.to(2.0, seen);
  MESSAGE(run.steps, " steps, ", run.refused, " refused, error ", seen.error);
  CHECK(run.verdict.acceptable());
  CHECK(run.refused <= 6);
  CHECK(run.steps < 80);
  CHECK(seen.error < 0.03);
}

TEST_CASE("a consolidation in steps by its error that was saved goes on with the same bits") {
  auto const grid = column_grid(10);
  auto const model = column(grid, water_in(grid, 1e-3, {{1.0, 0.0}, {2.0, 1.0}}), TimeFunction::ramp(0.0, 1.0));
  scarp::SerialExecutor serial;
  auto whole = model.problem(serial);
  auto resumed = model.problem(serial);
  scarp::QuasiNewton<> const newton;
  scarp::NoObserver nobody;
  REQUIRE(at_once.run(newton, whole, 0.0, 1.0, nobody).verdict.acceptable());
  REQUIRE(by_error.run(newton, whole, 1.0, 1.3, nobody).verdict.acceptable());
  auto const saved = bits_of(whole);
  scarp::StateReader reader(saved);
  reader("state", resumed);
  CHECK(reader.at_end());
  auto stepping = by_error;
  stepping.first = 1e-2;  // too long for a state at rest, which one that knew no rate would be
  for (auto* problem : {&whole, &resumed}) {
    auto const run = stepping.run(newton, *problem, 1.3, 2.0, nobody);
    REQUIRE(run.verdict.acceptable());
    CHECK(run.refused == 0);
  }
  CHECK(bits_of(whole) == bits_of(resumed));
}

TEST_CASE("a step that a knot has cut short does not make a rate of what the solver has left") {
  constexpr double rate = 10.0;
  constexpr double left = 0.1;
  auto const change = [](double value) { return Eigen::VectorXd::Constant(1, value); };
  scarp::detail::TimeError error;
  error.commit(change(rate), 1.0);
  error.commit(change(rate * 1e-3 + left), 1e-3);
  CHECK(error.of(change(rate), 1.0) < left);
  error.commit(change(rate), 1.0);  // a long step is its own
  CHECK(error.of(change(rate), 1.0) == 0.0);
}

TEST_CASE("a time error without sense is refused") {
  auto const grid = column_grid(2);
  for (double const wrong : {0.0, -1.0, infinite, std::numeric_limits<double>::quiet_NaN()})
    CHECK_REFUSED(water_in(grid, wrong, {{1.0, 0.0}, {2.0, 1.0}}), "largest time error of the pore water");
}

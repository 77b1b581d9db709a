// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/load_stepping.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "scarp/bvp/discretisation.hpp"
#include "support/approx.hpp"
#include "support/block.hpp"
#include "support/crossed_rectangle.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Softening;
using scarp::Reason;
using scarp::Status;
using scarp::Verdict;
using SoftBlock = samples::Block<Softening>;

static_assert(scarp::ObservesSteps<scarp::NoObserver, SoftBlock::Problem> &&
              !scarp::ObservesSteps<scarp::SerialExecutor, SoftBlock::Problem>);

scarp::LoadStepping stepping() {
  return {.first = 1e-3, .smallest = 1e-6, .largest = 4e-3, .max_displacement_gradient = 0.1};
}

double largest_strain(SoftBlock::Problem const& problem) {
  double largest = 0.0;
  for (int k = 0; k < problem.points().size(); ++k) {
    largest = std::max(largest, problem.points().state<Softening::State>(k).strain.norm());
  }
  return largest;
}

/// Largest difference of the top's height to 1 m plus the load.
double height_error(SoftBlock::Problem const& problem, double load) {
  double worst = 0.0;
  for (int const node : scarp::boundary_nodes(problem.discretisation().mesh(), "top")) {
    worst =
        std::max(worst, std::abs(problem.discretisation().positions()[static_cast<std::size_t>(node)](1) - 1.0 - load));
  }
  return worst;
}

/// Course up to a peak that no sum of growing steps meets, and back to nothing, which lasts.
scarp::TimeFunction there_and_back() { return scarp::TimeFunction({{0.0, 0.0}, {0.37, 1.0}, {0.81, 0.0}}); }

/// A linear block whose top carries 100 kPa, or moves up by 5 mm, over that course.
SoftBlock::Problem there_and_back(bool is_moved, scarp::SerialExecutor& executor) {
  SoftBlock::Grid grid(samples::CrossedRectangle{.columns = 3, .rows = 2}.generate());
  scarp::Constraints constraints(grid.mesh());
  scarp::LoadHistory loads;
  for (int const node : scarp::boundary_nodes(grid.mesh(), "bottom")) constraints.fix(node);
  if (is_moved) {
    for (int const node : scarp::boundary_nodes(grid.mesh(), "top")) constraints.move(node, 1, 5e-3, there_and_back());
  } else {
    loads.add(grid.traction("top", scarp::Vector<2>(0.0, -100e3)), there_and_back());
  }
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  return {std::move(grid), {Softening{}, sites}, std::move(constraints), std::move(loads), executor};
}

}  // namespace

TEST_CASE("a softening block is pulled past its peak in steps that the observer hears of one by one") {
  scarp::SerialExecutor serial;
  auto problem = SoftBlock::make({.reference_strain = 0.02}, serial);
  auto witness = samples::watch(problem);
  scarp::QuasiNewton<> const solver{.tolerance = 1e-6};
  auto const run = stepping().run(solver, problem, 0.0, 0.03, witness);
  CHECK(run.verdict == Verdict{});
  CHECK(run.load == 0.03);
  CHECK(run.largest_residual <= solver.tolerance);
  CHECK(run.steps + run.refused == static_cast<int>(witness.reports.size()));
  CHECK(witness.changed_by_refused == 0);
  CHECK(witness.unchanged_by_accepted == 0);
  long iterations = 0;
  double load = 0.0;
  for (auto const& report : witness.reports) {
    iterations += report.iterations();
    if (!report.verdict.acceptable()) continue;
    CHECK(report.load > load);
    CHECK(report.load - load == samples::Approx(report.load_increment).epsilon(1e-9));
    load = report.load;
  }
  CHECK(iterations == run.iterations);
  // Analytic: prescribed displacement = load factor; a sum of some tens of increments, the last cut off at `smallest`.
  CHECK(height_error(problem, 0.03) < 1e-6);
  // Analytic: the law's slope r + (1-r)(1-2x^2)exp(-x^2) is negative between x = 0.88 and 1.72: the peak was passed.
  CHECK(largest_strain(problem) > 0.88 * 0.02);
}

TEST_CASE("a step that fails is rolled back to the bit and tried again in smaller ones") {
  scarp::SerialExecutor serial;
  auto problem = SoftBlock::make({.largest_increment = 1.5e-3}, serial);
  auto witness = samples::watch(problem);
  auto const run = stepping().run(scarp::QuasiNewton<>{}, problem, 0.0, 0.02, witness);
  CHECK(run.verdict == Verdict{});
  CHECK(run.load == 0.02);
  CHECK(run.refused >= 2);
  CHECK(run.last_failure == Reason::cell_collapsed);
  CHECK(witness.changed_by_refused == 0);
  // An attempt after a refused one is half as large.
  for (std::size_t k = 1; k < witness.reports.size(); ++k) {
    if (witness.reports[k - 1].verdict.acceptable()) continue;
    CHECK(witness.reports[k].load_increment == 0.5 * witness.reports[k - 1].load_increment);
    CHECK(witness.reports[k].step == witness.reports[k - 1].step);
  }
  CHECK(height_error(problem, 0.02) < 1e-6);
}

TEST_CASE("a material that ends somewhere ends the run there, with its reason and its point") {
  scarp::SerialExecutor serial;
  constexpr double limit = 0.01;
  auto problem = SoftBlock::make({.largest_strain = limit}, serial);
  auto witness = samples::watch(problem);
  auto const run = stepping().run(scarp::QuasiNewton<>{.tolerance = 1e-6}, problem, 0.0, 0.1, witness);
  CHECK(run.verdict == Verdict{Status::not_converged, Reason::step_too_small});
  CHECK(run.last_failure == Reason::cell_collapsed);
  CHECK(run.load > 0.0);
  CHECK(run.load < 0.1);
  CHECK(witness.changed_by_refused == 0);
  CHECK(height_error(problem, run.load) < 1e-6);
  // Close below the limit: one more step of `smallest` = 1e-6 m on 1 m, concentrated a few times, would cross it.
  CHECK(largest_strain(problem) <= limit);
  CHECK(largest_strain(problem) > limit - 1e-5);
  REQUIRE(run.worst_point >= 0);
  CHECK(problem.points().state<Softening::State>(run.worst_point).strain.norm() > limit - 1e-5);
}

TEST_CASE("a stress that is not a number is reported with its point and never committed") {
  scarp::SerialExecutor serial;
  constexpr int silent = 7;
  auto problem = SoftBlock::make({.largest_strain = 5e-3, .silent_point = silent}, serial);
  auto witness = samples::watch(problem);
  auto const run = stepping().run(scarp::QuasiNewton<>{}, problem, 0.0, 0.1, witness);
  CHECK(run.verdict == Verdict{Status::not_converged, Reason::step_too_small});
  CHECK(run.last_failure == Reason::not_finite);
  CHECK(run.worst_point == silent);
  CHECK(witness.changed_by_refused == 0);
  CHECK(run.load > 0.0);
  for (auto const& stress : problem.committed_stresses()) CHECK(stress.allFinite());
  for (auto const& position : problem.discretisation().positions()) CHECK(position.allFinite());
}

TEST_CASE("a stress that is not a number is seen even where no free node feels it") {
  // One triangle, all nodes prescribed, and a dead load that a residual could be measured against instead.
  scarp::Mesh<scarp::Tri3> mesh;
  mesh.nodes = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}};
  mesh.elements = {{0, 1, 2}, {1, 3, 2}};
  mesh.element_region = {0, 0};
  mesh.regions = {"soil"};
  scarp::Constraints constraints(mesh);
  for (int const node : {0, 1, 2}) constraints.fix(node);
  SoftBlock::Grid grid(mesh);
  std::vector<scarp::Site<2>> sites{grid.site(0, 1.0), grid.site(1, 1.0)};
  Eigen::VectorXd load = Eigen::VectorXd::Zero(8);
  load(7) = -1e3;
  scarp::SerialExecutor serial;
  SoftBlock::Problem problem(grid, {Softening{.largest_strain = -1.0, .silent_point = 0}, sites}, constraints, load,
                             serial);
  auto witness = samples::watch(problem);
  auto const run = stepping().settle(scarp::QuasiNewton<>{}, problem, 0.0, witness);
  CHECK(run.verdict == Verdict{Status::failed, Reason::not_finite});
  CHECK(run.worst_point == 0);
  CHECK(run.steps == 0);
}

TEST_CASE("iterations that are used up are a failure and nothing is committed") {
  scarp::SerialExecutor serial;
  auto problem = SoftBlock::make({.reference_strain = 0.02}, serial);
  auto witness = samples::watch(problem);
  samples::Committed<SoftBlock::Problem> const before(problem);
  scarp::QuasiNewton<> const solver{.tolerance = 1e-30, .max_iterations = 3};
  auto const run = stepping().run(solver, problem, 0.0, 0.01, witness);
  CHECK(run.verdict == Verdict{Status::not_converged, Reason::step_too_small});
  CHECK(run.last_failure == Reason::iterations_spent);
  CHECK(run.steps == 0);
  CHECK(run.load == 0.0);
  for (auto const& report : witness.reports) CHECK(report.iterations() == 3);
  CHECK(samples::Committed<SoftBlock::Problem>(problem) == before);
}

TEST_CASE("an observer stops a run between two attempts") {
  scarp::SerialExecutor serial;
  auto problem = SoftBlock::make({.reference_strain = 0.02}, serial);
  auto witness = samples::watch(problem);
  witness.stop_after = 3;
  auto const run = stepping().run(scarp::QuasiNewton<>{}, problem, 0.0, 0.02, witness);
  CHECK(run.verdict == Verdict{Status::not_converged, Reason::interrupted});
  CHECK(witness.reports.size() == 3);
  CHECK(run.load == witness.reports.back().load);
  CHECK(height_error(problem, run.load) < 1e-6);
  // What was stopped can go on.
  witness.stop_after = 1000;
  CHECK(stepping().run(scarp::QuasiNewton<>{}, problem, run.load, 0.02, witness).verdict == Verdict{});
}

TEST_CASE("settling that an observer stops counts as never made") {
  SoftBlock::Grid grid(samples::CrossedRectangle{.columns = 3, .rows = 2}.generate());
  scarp::Constraints constraints(grid.mesh());
  for (int const node : scarp::boundary_nodes(grid.mesh(), "bottom")) constraints.fix(node);
  Eigen::VectorXd const weight = grid.body_force([](int) { return scarp::Vector<2>(0.0, -2e4); });
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  scarp::SerialExecutor serial;
  SoftBlock::Problem problem(grid, {Softening{.reference_strain = 0.002}, sites}, constraints, weight, serial);
  auto witness = samples::watch(problem);
  witness.stop_after = 0;
  auto const stopped = stepping().settle(scarp::QuasiNewton<>{}, problem, 0.0, witness);
  CHECK(stopped.verdict == Verdict{Status::not_converged, Reason::interrupted});
  CHECK(stopped.refused == 0);
  CHECK(stopped.last_failure == Reason::none);
  CHECK(witness.reports.empty());
  CHECK(samples::Committed<SoftBlock::Problem>(problem) == witness.committed);
  witness.stop_after = 1000;
  CHECK(stepping().settle(scarp::QuasiNewton<>{}, problem, 0.0, witness).verdict == Verdict{});
}

TEST_CASE("the prediction's largest gradient limits every step before it is tried") {
  scarp::SerialExecutor serial;
  auto problem = SoftBlock::make({}, serial);
  auto witness = samples::watch(problem);
  auto steps = stepping();
  steps.largest = 1.0;
  steps.first = 1.0;
  steps.max_displacement_gradient = 2e-3;
  auto const run = steps.run(scarp::QuasiNewton<>{}, problem, 0.0, 0.02, witness);
  CHECK(run.verdict == Verdict{});
  CHECK(run.refused == 0);
  CHECK(run.steps >= 10);  // analytic: the mean strain alone, 0.02, takes ten steps of at most 2e-3
  for (auto const& report : witness.reports) CHECK(report.max_displacement_gradient <= 1.001 * 2e-3);
}

TEST_CASE("a prediction that turns elements inside out is cut before it is tried") {
  using MovingBlock = samples::Block<Softening, scarp::UpdatedLagrangian>;
  struct FirstAttempt {
    scarp::StepReport seen{};
    bool ended = false;
    void attempted(MovingBlock::Problem const&, scarp::StepReport const& report) {
      seen = report;
      ended = true;
    }
    bool wants_stop() const { return ended; }
  } first;
  scarp::SerialExecutor serial;
  auto problem = MovingBlock::make({}, serial);
  auto steps = stepping();
  steps.largest = steps.first = 10.0;  // [m]: the block of 1 m would become narrower by four times its width
  CHECK_FALSE(steps.run(scarp::QuasiNewton<>{}, problem, 0.0, 10.0, first).verdict.acceptable());
  CHECK(first.seen.verdict == Verdict{});
  CHECK(first.seen.max_displacement_gradient <= 1.001 * steps.max_displacement_gradient);
}

TEST_CASE("steps end at the knots of loads and prescribed motions, and a body may be unloaded to nothing") {
  scarp::SerialExecutor serial;
  for (bool const is_moved : {false, true}) {
    CAPTURE(is_moved);
    auto problem = there_and_back(is_moved, serial);
    auto witness = samples::watch(problem);
    scarp::LoadStepping const steps{.first = 0.1, .largest = 0.2, .max_displacement_gradient = 0.1};
    auto const run = steps.run(scarp::QuasiNewton<>{.tolerance = 1e-8}, problem, 0.0, 1.0, witness);
    CHECK(run.verdict == Verdict{});
    CHECK(run.refused == 0);
    std::vector<double> loads;
    for (auto const& report : witness.reports) loads.push_back(report.load);
    // 0.1, 0.14, 0.196 and 0.2: the steps of 0.13 and 0.044 that knots cut short leave the next ones as long.
    for (double const expected : {0.1, 0.24, 0.37, 0.566, 0.766, 0.81, 1.0}) {
      REQUIRE_FALSE(loads.empty());
      CHECK(loads.front() == samples::Approx(expected).epsilon(1e-12));
      loads.erase(loads.begin());
    }
    CHECK(loads.empty());
    CHECK(largest_strain(problem) < 1e-8);  // analytic: zero; the largest was 5e-3
  }
}

TEST_CASE("a peak that is narrower than the smallest increment is not passed by") {
  scarp::SerialExecutor serial;
  auto problem = SoftBlock::make({}, serial);
  SoftBlock::Grid const& grid = problem.discretisation();
  scarp::Constraints constraints(grid.mesh());
  scarp::TimeFunction const course({{0.0, 0.0}, {0.5, 0.0}, {0.50004, 1.0}, {0.50008, 0.0}});
  for (int const node : scarp::boundary_nodes(grid.mesh(), "bottom")) constraints.fix(node);
  for (int const node : scarp::boundary_nodes(grid.mesh(), "top")) constraints.move(node, 1, 1e-3, course);
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  SoftBlock::Problem pulled(grid, {Softening{}, sites}, std::move(constraints), {}, serial);
  auto witness = samples::watch(pulled);
  scarp::LoadStepping const steps{.first = 0.3, .smallest = 1e-4, .max_displacement_gradient = 0.1};
  REQUIRE(steps.run(scarp::QuasiNewton<>{}, pulled, 0.0, 1.0, witness).verdict == Verdict{});
  std::vector<double> loads;
  for (auto const& report : witness.reports) loads.push_back(report.load);
  for (double const knot : {0.5, 0.50004, 0.50008}) CHECK(std::ranges::count(loads, knot) == 1);
}

TEST_CASE("a run that goes on from a saved state is unloaded with the scale of forces that it had") {
  scarp::SerialExecutor serial;
  scarp::NoObserver no_observer;
  scarp::QuasiNewton<> const solver{.tolerance = 1e-8};
  auto problem = there_and_back(false, serial);
  REQUIRE(stepping().settle(solver, problem, 0.0, no_observer).verdict == Verdict{});
  scarp::LoadStepping const steps{.first = 0.37, .max_displacement_gradient = 0.1};
  REQUIRE(steps.run(solver, problem, 0.0, 0.81 - 1e-6, no_observer).verdict == Verdict{});
  scarp::StateWriter writer;
  writer("problem", problem);
  auto resumed = there_and_back(false, serial);
  scarp::StateReader reader(writer.bits());
  reader("problem", resumed);
  Eigen::VectorXd const slight = Eigen::VectorXd::Constant(problem.dof_count(), 1e-3);  // [N], of 1e5 N at the peak
  std::vector<double> residuals;
  for (auto* const one : {&problem, &resumed}) {
    CHECK(steps.run(solver, *one, 0.81 - 1e-6, 0.81, no_observer).verdict == Verdict{});
    residuals.push_back(one->residual(slight));
  }
  CHECK(residuals[0] == residuals[1]);
  CHECK(residuals[0] < 1e-3);
}

TEST_CASE("a body that nothing holds is not called balanced") {
  scarp::SerialExecutor serial;
  auto const held = SoftBlock::make({}, serial);
  auto const& grid = held.discretisation();
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  Eigen::VectorXd const load = Eigen::VectorXd::Constant(grid.dof_count(), 1e3);
  SoftBlock::Problem problem(grid, {Softening{}, sites}, scarp::Constraints(grid.mesh()), load, serial);
  scarp::NoObserver no_observer;
  auto const run = stepping().settle(scarp::QuasiNewton<>{}, problem, 0.0, no_observer);
  CHECK_FALSE(run.verdict.acceptable());
  CHECK(run.steps == 0);
  CHECK(problem.discretisation().positions() == grid.positions());
}

namespace {

/// Linear; from a strain on it tells a tangent of nothing.
struct Exhausted {
  static constexpr int dim = 2;
  static constexpr bool exact_tangent = true;
  using State = Softening::State;
  Softening law{};
  double largest = 1e-3;

  State initial_state(scarp::Site<2> const& site) const { return law.initial_state(site); }
  scarp::VoigtStress<2> stress(State const& state) const { return law.stress(state); }
  scarp::VoigtTangent<2> tangent(State const& state) const {
    return state.strain.norm() < largest ? law.tangent(state) : scarp::VoigtTangent<2>(scarp::VoigtTangent<2>::Zero());
  }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    return law.respond(committed, increment, trial);
  }
};

}  // namespace

TEST_CASE("a step that cannot begin is reported with its load and its reason, and counts as refused") {
  using Block = samples::Block<Exhausted>;
  scarp::SerialExecutor serial;
  auto problem = Block::make({}, serial);
  auto witness = samples::watch(problem);
  auto const run = stepping().run(scarp::QuasiNewton<>{}, problem, 0.0, 0.1, witness);
  CHECK(run.verdict == Verdict{Status::failed, Reason::singular_system});
  REQUIRE(run.steps > 0);
  REQUIRE(run.load > 0.0);
  CHECK(run.last_failure == Reason::singular_system);
  CHECK(run.refused == 1);
  CHECK(run.weak_dof >= 0);
  auto const& last = witness.reports.back();
  CHECK(last.verdict == run.verdict);
  CHECK(last.load == run.load);
  CHECK(last.step == run.steps + 1);
  CHECK(witness.reports[witness.reports.size() - 2].load == run.load);
}

TEST_CASE("a run refuses bounds that are no numbers") {
  scarp::SerialExecutor serial;
  auto problem = SoftBlock::make({}, serial);
  scarp::NoObserver no_observer;
  double const nan = std::nan("");
  scarp::QuasiNewton<> const solver;
  auto const run = [&](scarp::LoadStepping const& steps, double from, double to) {
    return steps.run(solver, problem, from, to, no_observer);
  };
  CHECK_THROWS_WITH_AS(static_cast<void>(run(stepping(), 0.0, nan)), doctest::Contains("load factor"),
                       scarp::InputError);
  CHECK_REFUSED(run(stepping(), nan, 1.0), "load factor", "nan");
  CHECK_REFUSED(run(stepping(), 0.0, samples::infinity), "load factor", "inf");
  CHECK_THROWS_WITH_AS(static_cast<void>(run(stepping(), 1.0, 0.5)), doctest::Contains("it can only grow"),
                       scarp::InputError);
  CHECK_REFUSED(run({.first = nan}, 0.0, 1.0), "first load increment", "nan");
  CHECK_REFUSED(run({.first = 0.0}, 0.0, 1.0), "first load increment", "is 0");
  CHECK_REFUSED(run({.smallest = -1.0}, 0.0, 1.0), "smallest", "-1");
  CHECK_REFUSED(run({.max_displacement_gradient = nan}, 0.0, 1.0), "gradient", "nan");
  // Nothing to do is no error.
  CHECK(run(stepping(), 1.0, 1.0).verdict == Verdict{});
  CHECK(run(stepping(), 1.0, 1.0).steps == 0);
}

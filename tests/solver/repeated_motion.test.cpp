// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/approx.hpp"
#include "support/block.hpp"

namespace {

using Block = samples::Block<samples::Softening>;
using Solver = scarp::QuasiNewton<>;

/// Nearly to the peak in equal steps.
scarp::RunReport pulled(Block::Problem& problem, Solver const& solver) {
  scarp::NoObserver no_observer;
  scarp::LoadStepping const stepping{.first = 1e-3, .largest = 1e-3, .max_displacement_gradient = 0.1};
  return stepping.run(solver, problem, 0.0, 0.012, no_observer);
}

/// One step of the load factor, accepted if it ends in equilibrium.
scarp::StepReport step(auto& session, double from, double to, scarp::StopCondition const& stop = {}) {
  scarp::StepReport report;
  report.verdict = session.begin(from, to);
  REQUIRE(report.verdict.acceptable());
  Eigen::VectorXd increment = session.predict(from, to);
  session.correct(increment, report, stop);
  if (report.verdict.acceptable()) session.accept(increment);
  return report;
}

/// Counts how often its tangent is requested.
struct Counting : samples::Softening {
  std::shared_ptr<int> tangents = std::make_shared<int>(0);

  scarp::VoigtTangent<2> tangent(State const& state) const {
    ++*tangents;
    return samples::Softening::tangent(state);
  }
};

}  // namespace

TEST_CASE("steps that repeat the last motion take fewer iterations to the same state") {
  scarp::SerialExecutor serial;
  auto problem = Block::make({.reference_strain = 0.02}, serial);
  auto linear = Block::make({.reference_strain = 0.02}, serial);
  auto const repeated = pulled(problem, {.tolerance = 1e-6});
  auto const plain = pulled(linear, {.tolerance = 1e-6, .repeats_motion = false});
  REQUIRE(repeated.verdict.acceptable());
  REQUIRE(plain.verdict.acceptable());
  CHECK(repeated.steps == plain.steps);
  CHECK(repeated.iterations < plain.iterations);
  for (int node = 0; node < problem.discretisation().node_count(); ++node) {
    auto const place = [node](auto const& one) {
      return one.discretisation().positions()[static_cast<std::size_t>(node)];
    };
    CHECK((place(problem) - place(linear)).norm() < 1e-7);  // [m], of 12 mm: what the tolerance leaves open
  }
}

TEST_CASE("a prediction is the last step's motion, scaled by the load, where that motion led to equilibrium") {
  scarp::SerialExecutor serial;
  auto problem = Block::make({.reference_strain = 0.02}, serial);
  Solver const solver{.tolerance = 1e-8, .max_iterations = 8};
  Solver::Session<Block::Problem> session(solver, problem);
  auto const before = problem.discretisation().positions();
  REQUIRE(step(session, 0.0, 4e-3).verdict.acceptable());
  auto const repeats = [&] {
    REQUIRE(session.begin(4e-3, 5e-3).acceptable());
    Eigen::VectorXd const increment = session.predict(4e-3, 5e-3);
    double apart = 0.0;
    for (std::size_t node = 0; node < before.size(); ++node) {
      scarp::Vector<2> const last = problem.discretisation().positions()[node] - before[node];
      apart = std::max(apart, (increment.segment<2>(static_cast<Eigen::Index>(2 * node)) - 0.25 * last).norm());
    }
    return apart < 1e-12;
  };
  CHECK(repeats());
  // An attempt that was interrupted counts as never made.
  CHECK(step(session, 4e-3, 5e-3, [] { return true; }).interrupted());
  CHECK(repeats());
  // One that was refused is not repeated: the next prediction is linear.
  CHECK_FALSE(step(session, 4e-3, 0.5).verdict.acceptable());
  CHECK_FALSE(repeats());
}

TEST_CASE("what a step leaves unbalanced is made good by the next one: with one iteration a step it does not add up") {
  scarp::SerialExecutor serial;
  auto problem = Block::make({.reference_strain = 0.02}, serial);
  auto const run = pulled(problem, {.tolerance = 5e-2});
  REQUIRE(run.verdict.acceptable());
  CHECK(run.iterations == run.steps);
  CHECK(run.largest_residual < 1e-2);  // what the curve of one step leaves; that of all steps is 4e-2
}

TEST_CASE(
    "some load steps share an evaluation of the provider's tangents; after a refused one they are evaluated anew") {
  using Counted = samples::Block<Counting>;
  scarp::SerialExecutor serial;
  Counting const soil{{.reference_strain = 0.02}};
  auto problem = Counted::make(soil, serial);
  Solver const solver{.tolerance = 1e-6, .max_iterations = 8, .tangent_interval = 3};
  Solver::Session<Counted::Problem> session(solver, problem);
  int const points = problem.discretisation().point_count();
  std::vector<int> evaluations;
  auto const advance = [&](double from, double to) {
    *soil.tangents = 0;
    static_cast<void>(step(session, from, to));  // one is refused
    CHECK(*soil.tangents % points == 0);
    evaluations.push_back(*soil.tangents / points);
  };
  for (double const load : {0.0, 1e-3, 2e-3, 3e-3}) advance(load, load + 1e-3);
  CHECK(evaluations == std::vector{1, 0, 0, 1});
  evaluations.clear();
  advance(4e-3, 0.5);
  advance(4e-3, 5e-3);
  CHECK(evaluations == std::vector{0, 1});
}

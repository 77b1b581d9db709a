// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "scarp/solver/work_balance.hpp"
#include "support/approx.hpp"
#include "support/block.hpp"

namespace {

using samples::Softening;
using scarp::Reason;
using scarp::Status;
using scarp::Verdict;

enum class Illness { none, no_number, exploded, stuck };

/// Softening ground. One point may fall ill when it is strained beyond a limit, in increments that are too large.
/// Answers may jump by a stress and be `not_converged` while the plan is below 4.
struct Ground {
  static constexpr int dim = 2;
  using State = Softening::State;
  using Plan = int;
  static constexpr int ill_point = 5;

  Softening law{};
  Illness illness = Illness::none;
  double healthy_strain = 5e-3;
  double healthy_increment = 0.0;
  Plan first_plan = 4;
  double jump = 0.0;

  State initial_state(scarp::Site<2> const& site) const { return law.initial_state(site); }
  scarp::VoigtTangent<2> tangent(State const& state) const { return law.tangent(state); }
  scarp::VoigtStress<2> stress(State const& state) const { return law.stress(state); }
  Plan plan(State const&, scarp::Gradient<2> const&) const { return first_plan; }
  Plan refined(Plan plan) const { return std::min(2 * plan, 4); }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    return respond(committed, increment, trial, first_plan);
  }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial,
                             Plan plan) const {
    auto response = law.respond(committed, increment, trial);
    response.stress.array() += jump * (plan - first_plan);
    if (plan < 4) response.verdict = {Status::not_converged, Reason::unbalanced};
    bool const ill = committed.point == ill_point && trial.strain.norm() > healthy_strain &&
                     (trial.strain - committed.strain).norm() > healthy_increment;
    if (!ill) return response;
    switch (illness) {
      case Illness::none: break;
      case Illness::no_number: response.stress(1) = std::nan(""); break;
      case Illness::exploded: return {1e12 * response.stress, {Status::failed, Reason::too_deep}};
      case Illness::stuck: response.verdict = {Status::not_converged, Reason::unbalanced};
    }
    return response;
  }
};

Reason reason_of(Illness illness) {
  switch (illness) {
    case Illness::no_number: return Reason::not_finite;
    case Illness::exploded: return Reason::too_deep;
    case Illness::none: return Reason::none;
    case Illness::stuck: break;
  }
  return Reason::unbalanced;
}

using Block = samples::Block<Ground>;

Ground softening() { return {.law = {.reference_strain = 0.02}}; }

scarp::LoadStepping stepping() {
  return {.first = 2e-3, .smallest = 1e-6, .largest = 2e-3, .max_displacement_gradient = 0.1};
}

}  // namespace

TEST_CASE("one poisoned point among good ones is found, named, never committed, and answers again in smaller steps") {
  scarp::SerialExecutor serial;
  for (auto const illness : {Illness::no_number, Illness::exploded, Illness::stuck}) {
    CAPTURE(static_cast<int>(illness));
    for (bool const curable : {true, false}) {
      Ground const soil{.illness = illness, .healthy_increment = curable ? 3e-4 : 0.0};
      auto problem = Block::make(soil, serial);
      auto witness = samples::watch(problem);
      auto const run = stepping().run(scarp::QuasiNewton<>{.tolerance = 1e-6}, problem, 0.0, 0.012, witness);
      CHECK(run.refused > 0);
      CHECK(run.last_failure == reason_of(illness));
      CHECK(run.worst_point == soil.ill_point);
      CHECK(witness.changed_by_refused == 0);
      double const strain = problem.points().state<Softening::State>(soil.ill_point).strain.norm();
      if (curable) {
        CHECK(run.verdict == Verdict{});
        CHECK(run.load == 0.012);
        CHECK(strain > soil.healthy_strain);
      } else {
        CHECK(run.verdict == Verdict{Status::not_converged, Reason::step_too_small});
        CHECK(run.load > 0.0);
        CHECK(strain <= soil.healthy_strain);
      }
    }
  }
}

TEST_CASE("another tangent rule brings a softening block past its peak to the same state") {
  scarp::SerialExecutor serial;
  scarp::NoObserver no_observer;
  auto problem = Block::make(softening(), serial);
  auto same = Block::make(softening(), serial);
  auto steps = stepping();
  steps.shrink_above = 1000;
  scarp::QuasiNewton<samples::Frozen> const solver{.tolerance = 1e-8, .max_iterations = 1000};
  auto const run = steps.run(solver, problem, 0.0, 0.02, no_observer);
  REQUIRE(run.verdict == Verdict{});
  CHECK(run.largest_residual <= solver.tolerance);
  scarp::QuasiNewton<> const other{.tolerance = 1e-8, .max_iterations = 100};
  REQUIRE(stepping().run(other, same, 0.0, 0.02, no_observer).verdict == Verdict{});
  // The law knows the total strain only, so that the path does not matter: a residual of 1e-8 of the reactions,
  // magnified by the mild loss of stiffness past the peak.
  for (std::size_t n = 0; n < same.discretisation().positions().size(); ++n) {
    CHECK((problem.discretisation().positions()[n] - same.discretisation().positions()[n]).norm() < 1e-7);
  }
}

TEST_CASE("a change of stress that a refined plan makes does not pass for stiffness") {
  scarp::SerialExecutor serial;
  scarp::NoObserver no_observer;
  auto problem = Block::make({.first_plan = 1, .jump = 1e3}, serial);
  auto const run = stepping().run(scarp::QuasiNewton<>{.tolerance = 1e-9}, problem, 0.0, 1e-3, no_observer);
  CHECK(run.verdict == Verdict{});
  CHECK(run.steps == 1);
  // Analytic: the tangent is exact, so that one correction balances the jump of the first iteration.
  CHECK(run.iterations == 2);
}

TEST_CASE("external work is the internal work") {
  scarp::SerialExecutor serial;
  auto linear = Block::make({}, serial);
  auto yielding = Block::make(softening(), serial);
  scarp::QuasiNewton<> const solver{.tolerance = 1e-6};
  scarp::WorkBalance work(linear, 0.0);
  REQUIRE(stepping().run(solver, linear, 0.0, 0.02, work).verdict == Verdict{});
  // Analytic: a linear law stores half of stress times strain, for which the trapezoidal rule is exact.
  double stored = 0.0;
  auto const volumes = linear.discretisation().volumes(Eigen::VectorXd::Zero(linear.dof_count()));
  for (int k = 0; k < linear.points().size(); ++k) {
    auto const& state = linear.points().state<Softening::State>(k);
    stored += volumes[static_cast<std::size_t>(k)] * Softening{}.stress(state).dot(state.strain) / 2.0;
  }
  CHECK(work.internal() == samples::Approx(stored).epsilon(1e-12));
  CHECK(work.external() == samples::Approx(stored).epsilon(1e-5));  // the residual
  scarp::WorkBalance soft(yielding, 0.0);
  REQUIRE(stepping().run(solver, yielding, 0.0, 0.03, soft).verdict == Verdict{});
  CHECK(soft.external() > 0.0);
  CHECK(soft.external() < 0.8 * stored * 2.25);  // (3/2)^2: what a linear block would have taken
  CHECK(soft.gap() < 1e-3);
}

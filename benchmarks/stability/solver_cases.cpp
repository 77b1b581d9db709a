// SPDX-License-Identifier: BSL-1.0
// A block of softening Mohr-Coulomb ground under large increments, beyond its limit load, held too little.
#include <fmt/format.h>

#include <limits>

#include "scarp/bvp/constraints.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "stability/soil_block.hpp"
#include "stability/stability_case.hpp"

namespace stability {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double degree = std::numbers::pi / 180.0;
using Newton = scarp::QuasiNewton<>;

std::string words(scarp::RunReport const& run, Watch const& watch) {
  return fmt::format("{} (last rejection {}) at load {:.5g}, {} attempts, {} rejected, {} iterations",
                     name(run.verdict.reason), name(run.last_failure), run.load, watch.attempts, run.refused,
                     run.iterations);
}

/// Force that the base needs. [N]
double base_force(Block::Problem const& problem) {
  auto const& grid = problem.discretisation();
  Eigen::VectorXd forces;
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), problem.committed_stresses(), forces);
  double sum = 0.0;
  for (int const node : boundary_nodes(grid.mesh(), "bottom")) sum += forces(2 * node + 1);
  return sum;
}

/// All of a strain in one macroscopic step, if the solver can, against five hundred.
Outcome one_increment(double strain) {
  scarp::LoadStepping stepping{.first = 2.0 * strain, .smallest = 1e-8, .max_displacement_gradient = 10.0};
  Newton const newton{.tolerance = 1e-8, .rule = {.exact = {.floor = 1e-4}}};
  auto once = Block{}.make();
  Watch watch;
  auto const run = stepping.run(newton, once, 0.0, 2.0 * strain, watch);
  auto refined = Block{}.make();
  stepping.first = stepping.largest = 2.0 * strain / 500.0;
  Watch refined_watch;
  auto const path = stepping.run(newton, refined, 0.0, 2.0 * strain, refined_watch);
  if (!run.verdict.acceptable() || !path.verdict.acceptable())
    return {false, infinity, "not reached", words(run, watch) + "; refined: " + words(path, refined_watch)};
  // Implicit Euler and the strain of half-way are of first order at least.
  return at_most(2.0 * strain, relative(base_force(once), base_force(refined)), "difference of the force on the base",
                 words(run, watch));
}

/// Pressed through the peak: the force falls from its peak to less than that.
Outcome through_the_peak() {
  auto problem = Block{.material = ground(2e3)}.make();
  scarp::LoadStepping const stepping{.first = 1e-3, .smallest = 1e-8, .largest = 4e-3};
  Newton const newton{.tolerance = 1e-8, .rule = {.exact = {.floor = 1e-4}}};
  Newton::Session<Block::Problem> session(newton, problem);
  double peak = 0.0;
  double last = 0.0;
  Watch watch;
  scarp::RunReport run;
  for (int k = 1; k <= 20; ++k) {
    run = stepping.advance(session, problem, run.load, 0.004 * k, watch);
    if (!run.verdict.acceptable()) break;
    last = base_force(problem);
    peak = std::max(peak, last);
  }
  bool const named = run.verdict.acceptable() || run.verdict.reason == scarp::Reason::step_too_small;
  return {named && last < 0.95 * peak && watch.attempts < watch.most, last / peak, "force at the end over its peak",
          words(run, watch)};
}

/// A pressure that softening ground cannot carry: ends at the peak with a named status.
/// most: of the unconfined strength; without softening the block grows wider under its load before it gives way
Outcome beyond_the_limit_load(double residual_cohesion, double most) {
  auto problem = Block{.material = ground(residual_cohesion), .top = Block::Top::loaded}.make();
  scarp::LoadStepping const stepping{.first = 5e3, .smallest = 1.0};
  Newton const newton{.tolerance = 1e-8, .rule = {.exact = {.floor = 1e-4}}};
  Watch watch;
  auto const run = stepping.run(newton, problem, 0.0, 1e6, watch);
  // Unconfined strength 2 c cos(phi)/(1 - sin(phi)) = 69.3 kPa; the rough base adds to it.
  double const strength = 2.0 * 20e3 * std::cos(30.0 * degree) / (1.0 - std::sin(30.0 * degree));
  double const carried = run.load / strength;
  bool const named = run.verdict == scarp::Verdict{scarp::Status::not_converged, scarp::Reason::step_too_small};
  return {named && watch.attempts < watch.most && carried > 0.95 && carried < most &&
              relative(base_force(problem), run.load) < 1e-6,
          carried, "load carried over the unconfined strength", words(run, watch)};
}

/// A block that may slide along x: the status is singular, the degree of freedom is one along x.
Outcome mechanism() {
  auto problem = Block{.top = Block::Top::loaded, .base_held = false}.make();
  Watch watch;
  auto const run = scarp::LoadStepping{.first = 1.0}.run(Newton{}, problem, 0.0, 100.0, watch);
  bool const named =
      run.verdict.reason == scarp::Reason::singular_system || run.last_failure == scarp::Reason::singular_system;
  return {named && run.weak_dof >= 0 && run.weak_dof % 2 == 0 && watch.attempts < 100,
          static_cast<double>(watch.attempts), "attempts", describe_dof(problem.grid(), run.weak_dof)};
}

}  // namespace

Cases solver_cases() {
  Cases cases;
  auto const add = [&](std::string name, std::string expected, auto run) {
    cases.push_back({"solvers and load steps", std::move(name), std::move(expected), std::move(run)});
  };
  for (double const strain : {0.01, 0.05, 0.2}) {
    add(fmt::format("{:g} % of strain in one step", 100.0 * strain), "cut back if need be; as the refined path",
        [=](Size) { return one_increment(strain); });
  }
  add("softening, displacement prescribed", "through the peak, or step_too_small",
      [](Size) { return through_the_peak(); });
  add("perfect plasticity beyond the limit load", "step_too_small, beyond the unconfined strength",
      [](Size) { return beyond_the_limit_load(20e3, 2.0); });
  add("softening beyond the limit load", "step_too_small at the peak",
      [](Size) { return beyond_the_limit_load(2e3, 1.05); });
  add("block that may slide", "singular_system, a degree of freedom along x", [](Size) { return mechanism(); });
  return cases;
}

}  // namespace stability

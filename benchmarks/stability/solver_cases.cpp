// SPDX-License-Identifier: BSL-1.0
// A block of softening Mohr-Coulomb ground under large increments, beyond its limit load, held too little, with a
// poisoned point, by solvers that do not fit and with wrong input.
#include <fmt/format.h>

#include <limits>

#include "scarp/bvp/constraints.hpp"
#include "scarp/solver/tangent_rules.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "stability/groups.hpp"
#include "stability/measures.hpp"
#include "stability/soil_block.hpp"

namespace stability {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double degree = std::numbers::pi / 180.0;
using Newton = scarp::QuasiNewton<scarp::ConsistentTangent>;

std::string words(scarp::RunReport const& run, Watch const& watch) {
  return fmt::format("{} (last refusal {}) at load {:.5g}, {} attempts, {} refused, {} iterations",
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
  scarp::LoadStepping stepping{.first = 2.0 * strain, .smallest = 1e-8, .largest_gradient = 10.0};
  Newton const newton{.tolerance = 1e-8, .rule = {.floor = 1e-4}};
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

/// Does any point's tangent have a negative eigenvalue in its symmetric part? Their number.
int unstable_points(Block::Problem const& problem) {
  int count = 0;
  for (auto const& tangent : problem.committed_tangents()) {
    scarp::VoigtTangent<2> const symmetric = 0.5 * (tangent + tangent.transpose());
    double const scale = symmetric.norm();
    bool const negative = symmetric(0, 0) < -1e-9 * scale || symmetric(2, 2) < -1e-9 * scale ||
                          symmetric.determinant() < -1e-9 * std::pow(scale, 3) ||
                          symmetric.topLeftCorner<2, 2>().determinant() < -1e-9 * scale * scale;
    count += negative ? 1 : 0;
  }
  return count;
}

/// Pressed through the peak: the force falls from its peak to less than that, tangents with negative eigenvalues on
/// the way.
Outcome through_the_peak() {
  auto problem = Block{.material = ground(2e3)}.make();
  scarp::LoadStepping const stepping{.first = 1e-3, .smallest = 1e-8, .largest = 4e-3};
  Newton const newton{.tolerance = 1e-8, .rule = {.floor = 1e-4}};
  Newton::Session<Block::Problem> session(newton, problem);
  double peak = 0.0;
  double last = 0.0;
  int unstable = 0;
  Watch watch;
  scarp::RunReport run;
  for (int k = 1; k <= 20; ++k) {
    run = stepping.advance(session, problem, run.load, 0.004 * k, watch);
    if (!run.verdict.acceptable()) break;
    last = base_force(problem);
    peak = std::max(peak, last);
    unstable = std::max(unstable, unstable_points(problem));
  }
  bool const named = run.verdict.acceptable() || run.verdict.reason == scarp::Reason::step_too_small;
  return {named && unstable > 0 && last < 0.95 * peak && watch.attempts < watch.most, last / peak,
          "force at the end over its peak",
          words(run, watch) + fmt::format("; up to {} points with a negative eigenvalue", unstable)};
}

/// A pressure that softening ground cannot carry: ends at the peak with a named status.
/// most: of the unconfined strength; without softening the block grows wider under its load before it gives way
Outcome beyond_the_limit_load(double residual_cohesion, double most) {
  auto problem = Block{.material = ground(residual_cohesion), .top = Block::Top::loaded}.make();
  scarp::LoadStepping const stepping{.first = 5e3, .smallest = 1.0};
  Newton const newton{.tolerance = 1e-8, .rule = {.floor = 1e-4}};
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

/// A block that may slide along x: the status says singular, the degree of freedom is one along x.
Outcome mechanism() {
  auto problem = Block{.top = Block::Top::loaded, .base_held = false}.make();
  Watch watch;
  auto const run = scarp::LoadStepping{.first = 1.0}.run(Newton{}, problem, 0.0, 100.0, watch);
  bool const named =
      run.verdict.reason == scarp::Reason::singular_system || run.last_failure == scarp::Reason::singular_system;
  return {named && run.weak_dof >= 0 && run.weak_dof % 2 == 0 && watch.attempts < 100,
          static_cast<double>(watch.attempts), "attempts", describe_dof(problem.discretisation().mesh(), run.weak_dof)};
}

/// From some strain on one point answers NaN and says that all is well.
Outcome poisoned_point() {
  Block block;
  block.material.poisoned = 17;
  block.material.from_strain = 5e-3;
  auto problem = block.make();
  scarp::LoadStepping const stepping{.first = 2e-3, .smallest = 1e-5, .largest = 2e-3};
  Watch watch;
  auto const run = stepping.run(Newton{.tolerance = 1e-8, .rule = {.floor = 1e-4}}, problem, 0.0, 0.2, watch);
  bool whole = true;
  for (auto const& stress : problem.committed_stresses()) whole &= stress.allFinite();
  for (auto const& place : problem.discretisation().positions()) whole &= place.allFinite();
  double const shear = problem.materials().committed(17).own.plastic_shear;
  return {whole && !run.verdict.acceptable() && run.last_failure == scarp::Reason::not_finite &&
              run.worst_point == 17 && shear > 4e-3 && shear <= 5e-3 && watch.attempts < watch.most,
          shear, "last plastic shear of the point, poisoned from 5e-3",
          words(run, watch) + fmt::format(", point {}", run.worst_point)};
}

/// An accuracy that nothing reaches.
Outcome no_tolerance(double tolerance) {
  auto problem = Block{}.make();
  Watch watch;
  auto const run = scarp::LoadStepping{.first = 1e-3, .smallest = 1e-6}.run(Newton{.tolerance = tolerance}, problem,
                                                                            0.0, 0.02, watch);
  bool const named = run.verdict.reason == scarp::Reason::step_too_small || run.verdict.acceptable();
  return {named && watch.attempts < watch.most, static_cast<double>(watch.attempts), "attempts", words(run, watch)};
}

Outcome wrong_input() {
  int missed = 0;
  double const nan = std::nan("");
  auto const wants = [&](char const* expected, auto const& action) { missed += refuses(action, expected) ? 0 : 1; };
  auto problem = Block{}.make();
  scarp::NoObserver nobody;
  auto const run = [&](scarp::LoadStepping const& stepping, double from, double to) {
    return [&problem, &nobody, stepping, from, to] { stepping.run(Newton{}, problem, from, to, nobody); };
  };
  wants("first load increment", run({.first = 0.0}, 0.0, 1.0));
  wants("first load increment", run({.first = nan}, 0.0, 1.0));
  wants("smallest load increment", run({.smallest = -1.0}, 0.0, 1.0));
  wants("largest gradient", run({.largest_gradient = nan}, 0.0, 1.0));
  wants("load factor at the end", run({}, 0.0, nan));
  wants("load factor at the end", run({}, 0.0, infinity));
  wants("load factor at the start", run({}, nan, 1.0));
  wants("can only grow", run({}, 1.0, 0.0));
  auto const& mesh = problem.discretisation().mesh();
  wants("check the numbers", [&] { scarp::Constraints(mesh).fix(100000); });
  wants("check the numbers", [&] { scarp::Constraints(mesh).fix(0, 2); });
  wants("rate of a prescribed displacement", [&] { scarp::Constraints(mesh).move(0, 0, nan); });
  wants("prescribed twice", [&] {
    scarp::Constraints twice(mesh);
    twice.move(0, 0, 1.0);
    twice.move(0, 0, 2.0);
  });
  Eigen::VectorXd load = Eigen::VectorXd::Zero(problem.dof_count());
  load(3) = nan;
  wants("a load is not finite", [&] { scarp::LoadHistory const loads(load); });
  wants("must increase", [&] { scarp::TimeFunction const course({{0.0, 1.0}, {0.0, 2.0}}); });
  wants("load factor of a knot", [&] { scarp::TimeFunction const course({{nan, 1.0}}); });
  wants("Young's modulus", [&] { scarp::IsotropicElasticity::from_young_poisson(nan, 0.3); });
  wants("Poisson's ratio", [&] { scarp::IsotropicElasticity::from_young_poisson(1.0, 0.5); });
  wants("Lame's lambda", [&] { scarp::IsotropicElasticity::from_young_poisson(1e300, 0.49999999999999994); });
  return at_most(0.0, missed, "wrong inputs that were taken");
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
  add("a point that answers NaN", "not_finite, the point named, the last state whole",
      [](Size) { return poisoned_point(); });
  add("tolerance 0", "step_too_small within bounded work", [](Size) { return no_tolerance(0.0); });
  add("tolerance NaN", "step_too_small within bounded work", [](Size) { return no_tolerance(std::nan("")); });
  add("NaN, infinite, out of range", "refused", [](Size) { return wrong_input(); });
  return cases;
}

}  // namespace stability

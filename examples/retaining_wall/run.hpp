// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "choice.hpp"
#include "curve.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "wall.hpp"

namespace retaining_wall {

/// What is known of the ground's friction before the wall moves.
struct Friction {
  double angle = 0.0;      ///< [rad]
  double scatter = 0.0;    ///< standard deviation of what it was read from [rad], 0 where the angle is given
  double allowance = 0.0;  ///< by which the angle that the wall mobilises may differ [rad]
  std::string source{};
  std::vector<Curve> tests{};  ///< of all packings together, then of each depth
};

/// State of the wall after a load step.
struct Row {
  double strain = 0.0;  ///< wall displacement over the length of the ground
  Pressed pressed{};
  int iterations = 0;
  double residual = 0.0;

  double ratio() const { return pressed.force / pressed.overburden; }
};

/// How a movement of the wall went.
struct Outcome {
  Movement movement{};
  Friction friction{};
  std::vector<Row> rows{};
  scarp::RunReport run{};

  Extreme reached() const {
    Curve curve;
    for (auto const& row : rows) curve.add(row.strain, row.ratio());
    return curve.strain.empty() ? Extreme{} : extreme(curve, movement);
  }
  double formula() const { return rankine(movement, friction.angle); }
  /// Least and largest force over Rankine's that the friction's allowance explains.
  std::array<double, 2> interval() const {
    double const less = rankine(movement, friction.angle - friction.allowance) / formula();
    double const more = rankine(movement, friction.angle + friction.allowance) / formula();
    return {std::min(less, more), std::max(less, more)};
  }
  bool holds() const {
    auto const [least, most] = interval();
    double const error = reached().ratio / formula();
    return run.verdict.acceptable() && error >= least && error <= most;
  }
};

/// Observer that measures after every step.
struct Record {
  Wall const& wall;
  std::vector<Row> rows{};

  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& step) {
    if (!step.verdict.acceptable()) return;
    rows.push_back({step.load, pressed(problem, wall), step.iterations(), step.residual()});
  }
  static bool wants_stop() { return false; }
};

/// The ground comes to rest, then the wall moves to a strain of the ground.
template <class Soil, class Solver>
Outcome move_wall(Wall const& wall, Soil const& soil, Movement movement, Friction friction, Solver const& solver,
                  scarp::LoadStepping const& stepping, double strain, scarp::Executor& executor) {
  auto problem = wall.problem(soil, movement, executor);
  Record record{wall};
  auto run = stepping.settle(solver, problem, 0.0, record);
  if (run.verdict.acceptable()) run = joined(run, stepping.run(solver, problem, 0.0, strain, record));
  return {movement, std::move(friction), std::move(record.rows), run};
}

/// Both movements; each soil is compiled in a source of its own. \throws InputError, PreparationError
std::vector<Outcome> run_sand(Choice const& choice);
std::vector<Outcome> run_mohr_coulomb(Choice const& choice);

}  // namespace retaining_wall

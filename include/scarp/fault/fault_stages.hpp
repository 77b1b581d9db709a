// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace scarp {

/// Stages of ground over a fault by load factor, which is the throw [m] once it is positive: the ground comes to rest,
/// a structure is placed, the bedrock moves, and then it rests.
/// \tparam Solver such as `QuasiNewton`
template <class Solver = QuasiNewton<>>
struct FaultStages {
  Solver solver{};          ///< of each load step
  LoadStepping stepping{};  ///< of all stages
  double start = 0.0;       ///< load factor of the ground at rest, below 0 where a structure is placed
  double throw_to = 0.0;    ///< [m]
  double end = 0.0;         ///< load factor at the end of all stages, the throw or beyond

  /// First stage: the ground as prepared is brought into equilibrium.
  template <class ProblemType, class Observer>
  RunReport settle(ProblemType& problem, Observer& observer) const {
    return stepping.settle(solver, problem, start, observer);
  }

  /// Second stage: the structure is placed; without one nothing happens.
  template <class ProblemType, class Observer>
  RunReport place(ProblemType& problem, Observer& observer) const {
    LoadStepping const shares{.first = 0.05};  // of the load
    LoadStepping stage = stepping;
    stage.first = shares.first;
    stage.smallest = shares.smallest;
    stage.largest = shares.largest;
    return stage.run(solver, problem, start, 0.0, observer);
  }

  /// Third stage: the bedrock moves.
  template <class ProblemType, class Observer>
  RunReport rupture(ProblemType& problem, Observer& observer) const {
    return stepping.run(solver, problem, 0.0, throw_to, observer);
  }

  /// Last stage, where the end is beyond the throw: the bedrock rests, and what its motion has begun ends, such as
  /// drainage.
  template <class ProblemType, class Observer>
  RunReport rest(ProblemType& problem, Observer& observer) const {
    LoadStepping stage = stepping;
    stage.first = stage.largest = end - throw_to;  // steps end at knots
    stage.smallest = 1e-6 * stage.first;
    return stage.run(solver, problem, throw_to, end, observer);
  }
};

}  // namespace scarp

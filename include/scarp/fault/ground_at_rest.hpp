// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp {

/// Where the nodes were when the fault began to move: settlement counts from here, without what earlier stages brought.
/// Made by ground_at_rest(problem) between two stages, or as an observer of the stages: it copies the last accepted
/// state whose load factor is not positive. Only positions are stored, dim numbers for a node.
template <int Dim = 2>
struct GroundAtRest : NeverStops {
  std::vector<Vector<Dim>> positions;  ///< [m], for each node; empty until some were copied

  /// Copies the positions of an accepted state whose load factor is not positive.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    if (report.verdict.acceptable() && !(report.load > 0.0)) positions = problem.grid().positions();
  }

  /// The positions; where nothing was copied, those of the mesh's nodes [m].
  std::vector<Vector<Dim>> const& of(std::vector<Vector<Dim>> const& nodes) const {
    return positions.empty() ? nodes : positions;
  }

  SCARP_MEMBERS(positions)
};

/// The committed positions of a problem whose fault has not moved yet.
template <class Problem>
GroundAtRest<Problem::dim> ground_at_rest(Problem const& problem) {
  return {{}, problem.grid().positions()};
}

}  // namespace scarp

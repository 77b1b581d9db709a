// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "scarp/core/random.hpp"
#include "scarp/mesh/pattern_grid.hpp"

namespace scarp {

/// Moves the nodes inside a grid at random within a disc; the outline stays. Up to a share of 0.3 no half of a cell can
/// turn over: three corners that move by r keep their sense while the least height of their triangle is above 2 r, and
/// that of half a rectangle is at least 0.707 of its shorter side.
/// share: radius of the disc over the distance of the nearest neighbour along the grid lines; from 0 to 0.3
/// seed: the same one gives the same bits
/// \throws InputError for another share
inline void jitter_grid(std::vector<Vector<2>>& nodes, GridNumbers const& numbers, double share, std::uint64_t seed) {
  if (!(share >= 0.0 && share <= 0.3)) {
    reject("the jitter is {} (elements may turn over beyond 0.3): choose one from 0 to 0.3", share);
  }
  if (share == 0.0) return;
  auto const before = nodes;
  auto const at = [&](int i, int j) { return before[detail::index(numbers(i, j))]; };
  Random random(seed);
  auto const in_unit_disc = [&] {
    for (;;) {
      double const along = random.uniform(-1.0, 1.0);
      double const up = random.uniform(-1.0, 1.0);
      if (along * along + up * up <= 1.0) return Vector<2>(along, up);
    }
  };
  for (int i = 1; i < numbers.columns(); ++i) {
    for (int j = 1; j < numbers.rows(); ++j) {
      Vector<2> const here = at(i, j);
      double const nearest = std::min({(at(i - 1, j) - here).norm(), (at(i + 1, j) - here).norm(),
                                       (at(i, j - 1) - here).norm(), (at(i, j + 1) - here).norm()});
      nodes[detail::index(numbers(i, j))] += share * nearest * in_unit_disc();
    }
  }
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/packing.hpp"

namespace scarp {

/// Pose of one grain at its present orientation, in double.
template <class PackingType>
auto grain_pose(PackingType const& packing, std::size_t grain) {
  using Shape = typename PackingType::Shape;
  std::array<double, static_cast<std::size_t>(Shape::orientation_count)> orientation{};
  auto const stored = packing.orientation.row(grain);
  for (std::size_t k = 0; k < orientation.size(); ++k) orientation[k] = static_cast<double>(stored[k]);
  return Shape::pose(packing.population->size(grain), orientation);
}

/// Position [m] of a grain or, past the last grain, of a ghost.
template <class PackingType>
Point<PackingType::dim, double> grain_position(PackingType const& packing, std::size_t number) {
  constexpr int dim = PackingType::dim;
  std::size_t const grains = packing.grain_count();
  std::size_t const owner =
      number < grains ? number : static_cast<std::size_t>(packing.pairs.ghost_owner[number - grains]);
  Point<dim, double> place;
  for (int a = 0; a < dim; ++a) place[static_cast<std::size_t>(a)] = static_cast<double>(packing.position(owner, a));
  if (number >= grains) {
    auto const& shift = packing.pairs.ghost_shift[number - grains];
    for (int a = 0; a < dim; ++a) {
      for (int b = 0; b < dim; ++b)
        place[static_cast<std::size_t>(a)] += packing.cell(a, b) * shift[static_cast<std::size_t>(b)];
    }
  }
  return place;
}

/// Number of the grain behind a grain or ghost number.
template <class PackingType>
std::size_t grain_owner(PackingType const& packing, std::size_t number) {
  std::size_t const grains = packing.grain_count();
  return number < grains ? number : static_cast<std::size_t>(packing.pairs.ghost_owner[number - grains]);
}

/// Touch of a pair with the normal iterated until it stands still.
template <class Shape, class Pose>
Touch<Shape::dim, double> settled_touch(Pose const& first, Pose const& second, Point<Shape::dim, double> const& branch,
                                        Point<Shape::dim, double> const& start) {
  auto touch = Shape::touch(first, second, branch, start);
  if constexpr (Shape::remembers_normal) {
    constexpr int most_iterations = 30;  // quadratic convergence: a handful is usual
    constexpr double still = 1e-28;      // squared change of a unit vector, near round-off
    for (int k = 0; k < most_iterations; ++k) {
      auto const before = touch.normal;
      touch = Shape::touch(first, second, branch, before);
      double change = 0.0;
      for (std::size_t a = 0; a < before.size(); ++a) {
        change += (touch.normal[a] - before[a]) * (touch.normal[a] - before[a]);
      }
      if (change < still) break;
    }
  }
  return touch;
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/index.hpp"
#include "scarp/dem/packing.hpp"
#include "scarp/shape/settled_touch.hpp"

namespace scarp {

/// Number of the grain behind a row of the pair list.
template <class PackingType>
std::size_t grain_of_row(PackingType const& packing, std::size_t row) {
  std::size_t const rows = packing.row_count();
  std::size_t const own = row < rows ? row : detail::index(packing.pairs.ghost_owner[row - rows]);
  return own / static_cast<std::size_t>(part_count<typename PackingType::Shape>());
}

/// Pose of one part of a grain at its present orientation, in double.
template <class PackingType>
auto grain_pose(PackingType const& packing, std::size_t grain, int part = 0) {
  using Shape = typename PackingType::Shape;
  std::array<double, static_cast<std::size_t>(Shape::orientation_count)> orientation{};
  auto const stored = packing.orientation.row(grain);
  for (std::size_t k = 0; k < orientation.size(); ++k) orientation[k] = static_cast<double>(stored[k]);
  return part_pose<Shape>(packing.population->size(grain), orientation, part);
}

/// Pose of the part that stands in a row of the pair list.
template <class PackingType>
auto row_pose(PackingType const& packing, std::size_t row) {
  constexpr auto parts = static_cast<std::size_t>(part_count<typename PackingType::Shape>());
  std::size_t const rows = packing.row_count();
  std::size_t const own = row < rows ? row : detail::index(packing.pairs.ghost_owner[row - rows]);
  return grain_pose(packing, own / parts, static_cast<int>(own % parts));
}

/// Centre [m] of the grain behind a row of the pair list, moved where the row is a ghost.
template <class PackingType>
Point<PackingType::dim, double> row_position(PackingType const& packing, std::size_t row) {
  constexpr int dim = PackingType::dim;
  std::size_t const grain = grain_of_row(packing, row);
  std::size_t const rows = packing.row_count();
  Point<dim, double> place;
  for (int a = 0; a < dim; ++a) place[detail::index(a)] = static_cast<double>(packing.position(grain, a));
  if (row >= rows) {
    auto const& shift = packing.pairs.ghost_shift[row - rows];
    for (int a = 0; a < dim; ++a) {
      for (int b = 0; b < dim; ++b) place[detail::index(a)] += packing.cell(a, b) * shift[detail::index(b)];
    }
  }
  return place;
}

}  // namespace scarp

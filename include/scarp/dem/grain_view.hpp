// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/index.hpp"
#include "scarp/dem/packing.hpp"
#include "scarp/shape/converged_contact.hpp"

namespace scarp {

/// Row of the grain's part that stands in a row of the pair list: another one where that is a ghost.
template <class PackingType>
std::size_t owner_of_row(PackingType const& packing, std::size_t row) {
  std::size_t const rows = packing.row_count();
  return row < rows ? row : detail::index(packing.pairs.ghost_owner[row - rows]);
}

/// Number of the grain behind a row of the pair list.
template <class PackingType>
std::size_t grain_of_row(PackingType const& packing, std::size_t row) {
  return owner_of_row(packing, row) / static_cast<std::size_t>(part_count<typename PackingType::Shape>());
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
  std::size_t const own = owner_of_row(packing, row);
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

/// How the rows of a near pair touch: poses of both, the branch between the centres [m] and the touch.
/// \tparam PackingType a `Packing`
template <class PackingType>
struct PairGeometry {
  static constexpr int dim = PackingType::dim;  ///< of the packing's space
  using Shape = typename PackingType::Shape;    ///< of the grains

  PoseOf<Shape> first;                 ///< pose of the first row
  PoseOf<Shape> second;                ///< pose of the second row
  Point<dim, double> branch;           ///< from the first grain's centre to the second's [m]
  ContactGeometry<dim, double> touch;  ///< overlap, normal and arms

  /// pair: row in the list of near pairs
  PairGeometry(PackingType const& packing, std::size_t pair) {
    auto const& pairs = packing.pairs;
    auto const row_first = detail::index(pairs.first[pair]);
    auto const row_second = detail::index(pairs.second[pair]);
    auto const from = row_position(packing, row_first);
    branch = row_position(packing, row_second);
    Point<dim, double> start{};
    for (std::size_t a = 0; a < branch.size(); ++a) {
      branch[a] -= from[a];
      if constexpr (Shape::warm_starts_normal) start[a] = static_cast<double>(pairs.normal(pair, static_cast<int>(a)));
    }
    first = row_pose(packing, row_first);
    second = row_pose(packing, row_second);
    touch = converged_contact<Shape>(first, second, branch, start);
  }
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <boost/hana/tuple.hpp>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/points/region.hpp"
#include "scarp/solver/equilibrium_problem.hpp"

namespace scarp {

namespace detail {
/// The material points of a grid, whatever the level [m] is that depths are measured from.
template <int Dim, class Regions>
MaterialPoints<Dim> points_at(Grid<Dim> const& grid, double level, Regions const& regions, Executor const& executor) {
  std::vector<Site<Dim>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, level));
  auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
  return points_of_regions<Dim>(regions, grid.regions(), sites, volumes,
                                [&](int point) { return executor.owns(point); });
}
}  // namespace detail

/// The material points of a grid. surface_level [m]: height of the ground surface, from which depths are measured;
/// regions: a list, or a tuple of regions of different types
/// \throws InputError for a region that the mesh does not have, one given twice, one of the mesh without material, and
/// a surface at which no node lies
template <int Dim, class Regions>
MaterialPoints<Dim> make_points(Grid<Dim> const& grid, double surface_level, Regions const& regions,
                                Executor const& executor) {
  constexpr int up = Dim - 1;
  auto const [low, high] = std::ranges::minmax(grid.nodes(), {}, [](auto const& node) { return node(up); });
  auto const apart = [&](auto const& node) { return std::abs(node(up) - surface_level); };
  if (!(apart(*std::ranges::min_element(grid.nodes(), {}, apart)) <= 0.01 * (high(up) - low(up)))) {
    reject(
        "the ground surface is at a height of {} m (no node of the mesh, which goes from {} to {} m, lies there): give "
        "the height of the ground's upper nodes; ground above them counts as surcharge",
        surface_level, low(up), high(up));
  }
  return detail::points_at(grid, surface_level, regions, executor);
}

/// The composition root: one discretisation, a material for each region, constraints and loads, as a problem that a
/// solver can use. Regions are written as values, `make_problem(..., hana::make_tuple(Region{"soil", soil}))`.
/// attached: a body or a load, and a field, any or none
/// \throws InputError when the parts do not fit together
template <class GridType, class... Materials, class... Attached>
EquilibriumProblem<GridType> make_problem(GridType grid, double surface_level,
                                          boost::hana::tuple<Region<Materials>...> const& regions,
                                          Constraints constraints, LoadHistory loads, Executor& executor,
                                          Attached... attached) {
  std::optional<MaterialPoints<GridType::dim>> points;
  executor.together([&] { points.emplace(make_points(grid, surface_level, regions, executor)); });
  return {std::move(grid),  std::move(*points), std::move(constraints),
          std::move(loads), executor,           std::move(attached)...};
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scarp/bvp/discretisation.hpp"

namespace scarp {

/// As `Grid::body_force`.
template <int Dim>
Eigen::VectorXd body_force(Grid<Dim> const& grid, std::vector<Vector<Dim>> const& per_volume) {
  return grid.body_force(per_volume);
}

/// Body forces by force_of_region(number of a region): b [N/m3], shape (dim).
template <int Dim, class ForceOfRegion>
  requires std::convertible_to<std::invoke_result_t<ForceOfRegion const&, int>, Vector<Dim>> Eigen::VectorXd body_force(
      Grid<Dim> const& grid, ForceOfRegion const& force_of_region) {
    std::vector<Vector<Dim>> per_volume;
    for (int region = 0; region < detail::count(grid.regions()); ++region) {
      per_volume.push_back(force_of_region(region));
    }
    return grid.body_force(per_volume);
  }

/// As body_force, for a force per volume that varies within the elements; integrated exactly up to degree 4.
/// force_at(position on the initial mesh [m]): b [N/m3], shape (dim)
template <GivesRules Element, class Motion, class Scheme, class ForceAt>
Eigen::VectorXd varying_body_force(Discretisation<Element, Motion, Scheme> const& grid, ForceAt const& force_at) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(grid.dof_count());
  auto const force_in = [&](auto const& rows, auto const& shape) -> Vector<Element::dim> {
    Vector<Element::dim> const position = rows.transpose() * shape;
    return force_at(position);
  };
  for (auto const& nodes : grid.mesh().elements) {
    detail::add_cell_forces<Element>(grid.mesh().nodes, grid.thickness(), nodes, Element::template rule<4>(), force_in,
                                     forces);
  }
  return forces;
}

/// As `Grid::traction`.
template <int Dim>
Eigen::VectorXd traction(Grid<Dim> const& grid, std::string_view boundary,
                         std::type_identity_t<Vector<Dim>> const& per_area) {
  return grid.traction(boundary, per_area);
}

}  // namespace scarp

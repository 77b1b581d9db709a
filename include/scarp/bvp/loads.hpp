// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/precompiled.hpp"

namespace scarp {

namespace detail {
/// Adds the nodal forces [N] of a cell at its places on the initial mesh: \f$ \int N_a b \f$ with b =
/// force_at(corners, shape values) over the points of a rule.
template <class Cell, class Element, class Motion, class Scheme, class Rule, class ForceAt>
void add_cell_forces(Discretisation<Element, Motion, Scheme> const& discretisation,
                     std::array<int, Cell::nodes> const& nodes, Rule const& rule, ForceAt const& force_at,
                     Eigen::VectorXd& forces) {
  constexpr int dim = Element::dim;
  auto const rows = corners<Cell, dim>(nodes, discretisation.mesh().nodes);
  for (auto const& where : rule) {
    ShapeValues<Cell> const shape = Cell::shape(where.xi);
    Vector<dim> const force = force_at(rows, shape);
    double const size = discretisation.thickness() * where.weight * measure<Cell, dim>(rows, where.xi);
    for (int a = 0; a < Cell::nodes; ++a) {
      forces.template segment<dim>(dim * nodes[index(a)]) += shape(a) * size * force;
    }
  }
}
}  // namespace detail

/// Nodal forces [N], shape (dof_count), consistent with a force per volume on the initial mesh:
/// \f$ f_a = \int N_a b\,dV \f$. A dead load: mass is conserved, so the forces stay when the mesh deforms.
/// per_volume: b [N/m3] of every region of the mesh
/// \throws InputError unless there is one for each region
template <class Element, class Motion, class Scheme>
SCARP_EXPORT Eigen::VectorXd body_force(Discretisation<Element, Motion, Scheme> const& discretisation,
                                        std::vector<Vector<Element::dim>> const& per_volume) {
  auto const& mesh = discretisation.mesh();
  if (per_volume.size() != mesh.regions.size()) {
    reject("forces per volume are given for {} regions (the mesh has {}: {}): give one for each", per_volume.size(),
           mesh.regions.size(), listed(mesh.regions));
  }
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(discretisation.dof_count());
  for (int e = 0; e < detail::count(mesh.elements); ++e) {
    auto const& force = per_volume[detail::index(mesh.element_region[detail::index(e)])];
    detail::add_cell_forces<Element>(
        discretisation, mesh.elements[detail::index(e)],
        Element::quadrature(), [&](auto const&, auto const&) -> auto const& { return force; }, forces);
  }
  return forces;
}

/// Body forces by force_of_region(number of a region): b [N/m3], shape (dim).
template <class Element, class Motion, class Scheme, class ForceOfRegion>
  requires std::convertible_to<std::invoke_result_t<ForceOfRegion const&, int>, Vector<Element::dim>> Eigen::VectorXd
  body_force(Discretisation<Element, Motion, Scheme> const& discretisation, ForceOfRegion const& force_of_region) {
    std::vector<Vector<Element::dim>> per_volume;
    for (int region = 0; region < detail::count(discretisation.mesh().regions); ++region) {
      per_volume.push_back(force_of_region(region));
    }
    return body_force(discretisation, per_volume);
  }

/// As body_force, for a force per volume that varies within the elements; integrated exactly up to degree 4.
/// force_at(position on the initial mesh [m]): b [N/m3], shape (dim)
template <GivesRules Element, class Motion, class Scheme, class ForceAt>
Eigen::VectorXd varying_body_force(Discretisation<Element, Motion, Scheme> const& discretisation,
                                   ForceAt const& force_at) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(discretisation.dof_count());
  auto const force_in = [&](auto const& rows, auto const& shape) -> Vector<Element::dim> {
    Vector<Element::dim> const position = rows.transpose() * shape;
    return force_at(position);
  };
  for (auto const& nodes : discretisation.mesh().elements) {
    detail::add_cell_forces<Element>(discretisation, nodes, Element::template rule<4>(), force_in, forces);
  }
  return forces;
}

/// Nodal forces [N], shape (dof_count), consistent with a force per area [Pa] on a boundary of the initial mesh:
/// \f$ f_a = \int N_a t\,dA \f$. A dead load: it follows neither the size nor the direction of the deformed boundary.
/// \throws InputError for an unknown boundary
template <class Element, class Motion, class Scheme>
SCARP_EXPORT Eigen::VectorXd traction(Discretisation<Element, Motion, Scheme> const& discretisation,
                                      std::string_view boundary_name, Vector<Element::dim> const& per_area) {
  using Facet = typename Element::Facet;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(discretisation.dof_count());
  for (auto const& facet : boundary(discretisation.mesh(), boundary_name)) {
    detail::add_cell_forces<Facet>(
        discretisation, facet, Facet::quadrature(), [&](auto const&, auto const&) -> auto const& { return per_area; },
        forces);
  }
  return forces;
}

}  // namespace scarp

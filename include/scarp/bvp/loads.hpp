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

/// Nodal forces [N], shape (dof_count), consistent with a force per volume on the initial mesh:
/// \f$ f_a = \int N_a b\,dV \f$. A dead load: mass is conserved, so the forces stay when the mesh deforms.
/// per_volume: b [N/m3] of every region of the mesh
/// \throws InputError unless there is one for each region
template <class Element, class Motion, class Scheme>
SCARP_EXPORT Eigen::VectorXd body_force(Discretisation<Element, Motion, Scheme> const& discretisation,
                                        std::vector<Vector<Element::dim>> const& per_volume) {
  constexpr int dim = Element::dim;
  auto const& mesh = discretisation.mesh();
  if (per_volume.size() != mesh.regions.size()) {
    refuse("forces per volume are given for {} regions (the mesh has {}: {}): give one for each", per_volume.size(),
           mesh.regions.size(), listed(mesh.regions));
  }
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(discretisation.dof_count());
  for (int e = 0; e < detail::count(mesh.elements); ++e) {
    auto const& nodes = mesh.elements[detail::index(e)];
    auto const& force = per_volume[detail::index(mesh.element_region[detail::index(e)])];
    auto const rows = corners<Element, dim>(nodes, mesh.nodes);
    for (auto const& where : Element::quadrature()) {
      ShapeValues<Element> const shape = Element::shape(where.xi);
      double const volume = discretisation.thickness() * where.weight * measure<Element, dim>(rows, where.xi);
      for (int a = 0; a < Element::nodes; ++a) {
        forces.template segment<dim>(dim * nodes[detail::index(a)]) += shape(a) * volume * force;
      }
    }
  }
  return forces;
}

/// The same with force_of_region(number of a region): b [N/m3], shape (dim).
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
  constexpr int dim = Element::dim;
  auto const& mesh = discretisation.mesh();
  auto const rule = Element::template rule<4>();
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(discretisation.dof_count());
  for (auto const& nodes : mesh.elements) {
    auto const rows = corners<Element, dim>(nodes, mesh.nodes);
    for (auto const& where : rule) {
      ShapeValues<Element> const shape = Element::shape(where.xi);
      Vector<dim> const position = rows.transpose() * shape;
      Vector<dim> const per_volume = force_at(position);
      double const volume = discretisation.thickness() * where.weight * measure<Element, dim>(rows, where.xi);
      for (int a = 0; a < Element::nodes; ++a) {
        forces.template segment<dim>(dim * nodes[detail::index(a)]) += shape(a) * volume * per_volume;
      }
    }
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
  constexpr int dim = Element::dim;
  auto const& mesh = discretisation.mesh();
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(discretisation.dof_count());
  for (auto const& facet : boundary(mesh, boundary_name)) {
    auto const rows = corners<Facet, dim>(facet, mesh.nodes);
    for (auto const& where : Facet::quadrature()) {
      ShapeValues<Facet> const shape = Facet::shape(where.xi);
      double const area = discretisation.thickness() * where.weight * measure<Facet, dim>(rows, where.xi);
      for (int a = 0; a < Facet::nodes; ++a) {
        forces.template segment<dim>(dim * facet[detail::index(a)]) += shape(a) * area * per_area;
      }
    }
  }
  return forces;
}

}  // namespace scarp

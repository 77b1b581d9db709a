// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/core/index.hpp"
#include "scarp/element/map.hpp"

namespace scarp {

/// Nodal forces [N], shape (dof_count), of a force per volume that varies within the elements of the initial mesh;
/// integrated exactly up to degree 4 on undistorted elements.
/// force_at(position [m]): b [N/m3], shape (dim)
template <class Element, class Motion, class Scheme, class ForceAt>
Eigen::VectorXd varying_body_force(Discretisation<Element, Motion, Scheme> const& grid, ForceAt const& force_at) {
  constexpr int dim = Element::dim;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(grid.dof_count());
  for (auto const& nodes : grid.mesh().elements) {
    auto const rows = corners<Element, dim>(nodes, grid.mesh().nodes);
    for (auto const& point : Element::template rule<4>()) {
      ShapeValues<Element> const shape = Element::shape(point.xi);
      Vector<dim> const place = rows.transpose() * shape;
      Vector<dim> const force = force_at(place);
      double const size = grid.thickness() * point.weight * measure<Element, dim>(rows, point.xi);
      for (int a = 0; a < Element::nodes; ++a)
        forces.segment<dim>(dim * nodes[detail::index(a)]) += shape(a) * size * force;
    }
  }
  return forces;
}

}  // namespace scarp

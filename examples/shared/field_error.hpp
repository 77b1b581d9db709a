// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/core/error.hpp"

namespace examples {

/// Nodal forces [N], shape (dof_count), of a force per volume that varies within the elements of the initial mesh;
/// integrated exactly up to degree 4 on undistorted elements.
/// force_at(position [m]): b [N/m3], shape (dim)
template <class Element, class Motion, class Scheme, class ForceAt>
Eigen::VectorXd varying_body_force(scarp::Discretisation<Element, Motion, Scheme> const& grid,
                                   ForceAt const& force_at) {
  constexpr int dim = Element::dim;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(grid.dof_count());
  for (auto const& nodes : grid.mesh().elements) {
    auto const rows = scarp::corners<Element, dim>(nodes, grid.mesh().nodes);
    for (auto const& point : Element::template rule<4>()) {
      scarp::ShapeValues<Element> const shape = Element::shape(point.xi);
      scarp::Vector<dim> const place = rows.transpose() * shape;
      scarp::Vector<dim> const force = force_at(place);
      double const size = grid.thickness() * point.weight * scarp::measure<Element, dim>(rows, point.xi);
      for (int a = 0; a < Element::nodes; ++a)
        forces.segment<dim>(dim * nodes[static_cast<std::size_t>(a)]) += shape(a) * size * force;
    }
  }
  return forces;
}

/// Norms of the difference between a field on a mesh and a function of position, taken over the mesh's volume.
struct FieldError {
  double value = 0.0;     ///< \f$ L_2 \f$ norm, unit of the field times m^(dim/2)
  double gradient = 0.0;  ///< \f$ L_2 \f$ norm of the gradient (the \f$ H^1 \f$ seminorm)
};

/// Integrated exactly up to degree 5 on undistorted elements: differences of the order of the next polynomial that a
/// quadratic element lacks are resolved.
/// displacement [m], shape (dim * number of nodes); exact(x): shape (dim); exact_gradient(x): shape (dim, dim)
/// \throws InputError for a displacement of another length
template <class Element, class Exact, class ExactGradient>
FieldError field_error(scarp::Mesh<Element> const& mesh, Eigen::VectorXd const& displacement, Exact const& exact,
                       ExactGradient const& exact_gradient) {
  constexpr int dim = Element::dim;
  if (displacement.size() != dim * std::ssize(mesh.nodes)) {
    scarp::reject("the displacement has {} entries (the mesh needs {}): size it by dim * number of nodes",
                  displacement.size(), dim * std::ssize(mesh.nodes));
  }
  auto const rule = Element::template rule<5>();
  FieldError squares;
  for (auto const& element : mesh.elements) {
    auto const rows = scarp::corners<Element, dim>(element, mesh.nodes);
    scarp::Corners<Element, dim> moves;
    for (int a = 0; a < Element::nodes; ++a)
      moves.row(a) = displacement.template segment<dim>(dim * element[static_cast<std::size_t>(a)]).transpose();
    for (auto const& point : rule) {
      scarp::ShapeValues<Element> const shape = Element::shape(point.xi);
      auto const spatial = scarp::spatial_shape<Element>(rows, point);
      scarp::Vector<dim> const place = rows.transpose() * shape;
      scarp::Vector<dim> const off = moves.transpose() * shape - scarp::Vector<dim>(exact(place));
      scarp::Gradient<dim> const slope_off =
          moves.transpose().lazyProduct(spatial.gradients) - scarp::Gradient<dim>(exact_gradient(place));
      squares.value += spatial.volume * off.squaredNorm();
      squares.gradient += spatial.volume * slope_off.squaredNorm();
    }
  }
  return {std::sqrt(squares.value), std::sqrt(squares.gradient)};
}

}  // namespace examples

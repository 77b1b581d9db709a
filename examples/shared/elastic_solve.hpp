// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCholesky>

#include <vector>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/core/error.hpp"
#include "scarp/solver/linear_system.hpp"

namespace examples {

/// Displacement [m] of a linear elastic body in small strain, found by one direct solve.
/// prescribed [m], shape (dof_count): read at the constrained degrees of freedom; forces [N], shape (dof_count)
template <class Element, class Scheme>
Eigen::VectorXd elastic_solve(scarp::Discretisation<Element, scarp::SmallStrain, Scheme> const& grid,
                              scarp::LinearElastic<Element::dim> const& solid, scarp::Constraints const& constraints,
                              Eigen::VectorXd const& prescribed, Eigen::VectorXd const& forces) {
  constexpr int dim = Element::dim;
  auto const points = static_cast<std::size_t>(grid.point_count());
  std::vector<scarp::VoigtStress<dim>> const unstressed(points, scarp::VoigtStress<dim>::Zero());
  std::vector<scarp::VoigtTangent<dim>> const tangents(points, solid.tangent({}));
  Eigen::SparseMatrix<double> const stiffness =
      grid.stiffness(Eigen::VectorXd::Zero(grid.dof_count()), unstressed, tangents);
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(grid.dof_count());
  for (int const dof : constraints.prescribed_dofs()) {
    displacement(dof) = prescribed(dof);
  }
  scarp::LinearSystem system(constraints, scarp::direct_solver<Eigen::SimplicialLDLT<scarp::SparseMatrix>>);
  if (!system.factorize({stiffness}).acceptable()) {
    scarp::reject("the stiffness could not be factorised (a motion has no stiffness): fix more nodes");
  }
  system.scatter(system.solve(system.gather(forces - stiffness * displacement)), displacement);
  return displacement;
}

}  // namespace examples

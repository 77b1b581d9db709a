// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace scarp {

/// Work of the reactions at prescribed displacements per unit of their amplitude, the load factor where none is given [N], of the
/// mesh's whole thickness:
/// \f$ R = \sum_k \dot u_k r_k \f$ with the rate of each prescribed displacement and the nodal force of the stresses in the
/// committed state. Loads on these nodes are not subtracted: of a fault, whose load factor is the throw, the
/// difference to the ground at rest is what moving bedrock works against. On all ranks at once.
template <class Problem>
double generalised_reaction(Problem const& problem) {
  auto const& grid = problem.discretisation();
  Eigen::VectorXd forces;
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), problem.balanced_stresses(), forces);
  auto const& held = problem.constraints();
  double work = 0.0;
  for (Eigen::Index dof = 0; dof < forces.size(); ++dof)  // attached bodies come after its nodes
    work += held.rate(static_cast<int>(dof)) * forces(dof);
  return work;
}

}  // namespace scarp

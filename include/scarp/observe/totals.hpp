// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include "scarp/core/index.hpp"
#include "scarp/run/root_rank.hpp"

namespace scarp {

namespace detail {
/// visit(volume, points, k) for every point of the committed state: its volume [m2], in 3D [m3], and its number among
/// `points`.
template <class Problem, class Visit>
void for_each_volume(Problem const& problem, Visit const& visit) {
  auto const& grid = problem.grid();
  auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
  for (int point = 0; point < grid.point_count(); ++point)
    visit_point(problem, point, [&](auto const& points, int k) { visit(volumes[index(point)], points, k); });
}
}  // namespace detail

/// Volume of the solids of a committed state by the void ratios e of the packings, \f$ \sum v / (1 + e) \f$ over the
/// present volumes v of the points with packings; 0 without any. Solids neither come nor go: as far as this number
/// changes, the mesh has another change of volume than the packings. [m2], in 3D [m3]
template <class Problem>
double solid_volume(Problem const& problem) {
  double sum = 0.0;
  auto const quantities = own_quantities(problem);
  std::size_t point = 0;
  detail::for_each_volume(problem, [&](double volume, auto const& points, int k) {
    auto const& own = quantities[point++];
    for (auto const& [quantity, value] : own ? *own : points.quantities(k))
      if (quantity == "void_ratio") sum += volume / (1.0 + value);
  });
  return sum;
}

/// Share of the stiffness floors (constitutive/stiffness_floor.hpp) in all stress of a committed state,
/// \f$ \sum v |\sigma_{floor}| / \sum v |\sigma| \f$; 0 where no point is fluid.
template <class Problem>
double floor_share(Problem const& problem) {
  double floors = 0.0;
  double all = 0.0;
  detail::for_each_volume(problem, [&](double volume, auto const& points, int k) {
    all += volume * points.committed_stress(k).norm();
    floors += volume * points.floor_stress(k).norm();
  });
  return floors > 0.0 ? floors / all : 0.0;
}

/// Work of the reactions at prescribed displacements per unit of their amplitude, the load factor where none is given
/// [N], of the mesh's whole thickness: \f$ R = \sum_k \dot u_k r_k \f$ with the rate of each prescribed displacement
/// and the nodal force of the stresses, and of a field such as water, in the committed state. Loads on these nodes, and
/// what follows them, are not subtracted: of a fault, whose load factor is the throw, the difference to the ground at
/// rest is what moving bedrock works against. On all ranks at once.
template <class Problem>
double generalised_reaction(Problem const& problem) {
  auto const& grid = problem.grid();
  Eigen::VectorXd forces;
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), problem.balanced_stresses(), forces);
  if (problem.has_field()) forces += problem.field()->ground_force();
  double work = 0.0;
  for (Eigen::Index dof = 0; dof < forces.size(); ++dof)  // attached bodies come after its nodes
    work += problem.constraints().rate(static_cast<int>(dof)) * forces(dof);
  return work;
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include "scarp/run/root_rank.hpp"

namespace scarp {

/// Share of the stiffness floors (constitutive/stiffness_floor.hpp) in all stress of a problem's committed state:
/// \f$ \sum v |\sigma_{floor}| / \sum v |\sigma| \f$, 0 where no point is fluid.
template <class Problem>
double floor_share(Problem const& problem) {
  auto const& grid = problem.discretisation();
  auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
  double floors = 0.0;
  double all = 0.0;
  for (int point = 0; point < grid.point_count(); ++point) {
    double const volume = volumes[static_cast<std::size_t>(point)];
    visit_point(problem, point, [&](auto const& points, int k) {
      all += volume * points.committed_stress(k).norm();
      floors += volume * points.floor_stress(k).norm();
    });
  }
  return floors > 0.0 ? floors / all : 0.0;
}

}  // namespace scarp

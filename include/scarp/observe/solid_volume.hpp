// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include "scarp/run/root_rank.hpp"

namespace scarp {

/// Volume of the solids of a problem's committed state by its packings' void ratios e, \f$ \sum v / (1 + e) \f$ over the
/// present volumes v of the points with packings; 0 without any. Solids neither come nor go: as far as this number
/// changes, the mesh has another change of volume than the packings. [m2], in 3D [m3]
template <class Problem>
double solid_volume(Problem const& problem) {
  auto const& grid = problem.discretisation();
  auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
  double sum = 0.0;
  for (int point = 0; point < grid.point_count(); ++point) {
    visit_point(problem, point, [&](auto const& points, int k) {
      for (auto const& [quantity, value] : points.quantities(k))
        if (quantity == "void_ratio") sum += volumes[static_cast<std::size_t>(point)] / (1.0 + value);
    });
  }
  return sum;
}

}  // namespace scarp

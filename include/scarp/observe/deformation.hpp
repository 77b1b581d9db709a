// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/tensor/tensor.hpp"

namespace scarp {

/// Deformation that the material of a point receives: where increments are averaged, the mean around the point.
template <class Problem>
Tensor<Problem::dim> seen_deformation(Problem const& problem, int point) {
  auto const& grid = problem.grid();
  auto const* means = problem.points().means();
  if (!means) return grid.deformation(point);
  auto const shares = means->mean().of(point);
  Tensor<Problem::dim> mean = Tensor<Problem::dim>::Zero();
  for (auto const& share : shares) mean += share.weight * grid.deformation(share.point);
  return mean;
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <type_traits>

#include "scarp/element/map.hpp"

namespace scarp {

/// Gradient of the committed with respect to the initial position at a point; what its material sees may differ, see
/// MeanDilatation.
template <class DiscretisationType>
Tensor<DiscretisationType::dim> total_deformation(DiscretisationType const& discretisation, int point) {
  using Element = typename std::remove_cvref_t<decltype(discretisation.mesh())>::ElementType;
  constexpr int dim = DiscretisationType::dim;
  constexpr int per_element = DiscretisationType::points_per_element;
  auto const& nodes = discretisation.mesh().elements[static_cast<std::size_t>(point / per_element)];
  auto const shape = spatial_shape<Element>(corners<Element, dim>(nodes, discretisation.mesh().nodes),
                                            DiscretisationType::local_point(point));
  return corners<Element, dim>(nodes, discretisation.positions()).transpose().lazyProduct(shape.gradients);
}

/// Deformation that the material of a point receives: where increments are averaged, the mean around the point.
template <class Problem>
Tensor<Problem::dim> seen_deformation(Problem const& problem, int point) {
  auto const& grid = problem.discretisation();
  auto const* means = problem.points().means();
  if (!means) return total_deformation(grid, point);
  auto const shares = means->mean().of(point);
  Tensor<Problem::dim> mean = Tensor<Problem::dim>::Zero();
  for (auto const& share : shares) mean += share.weight * total_deformation(grid, share.point);
  return mean;
}

}  // namespace scarp

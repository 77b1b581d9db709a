// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <cstdlib>
#include <vector>

#include "scarp/core/error.hpp"

namespace scarp::detail {

/// Layer: a FaultMesh
template <class Layer>
void require_shape(Layer const& layer) {
  require_finite("left end of the layer", layer.left);
  require_finite("right end of the layer", layer.right);
  require_positive("depth of the layer", layer.depth);
  require_positive("length of the layer along the strike", layer.strike);
  if (!(layer.strike_cells >= 1 && layer.strike_cells <= 10'000)) {
    reject("the layer has {} cells along the strike (from 1 to 10000 are possible): choose another number",
           layer.strike_cells);
  }
  require_positive("element size", layer.size);
  require_positive("row aspect", layer.row_aspect);
  require_positive("row coarsening", layer.row_coarsening);
  if (!(layer.left < layer.right)) {
    reject("the layer reaches from x = {} to {} m (it has no width): put left below right", layer.left, layer.right);
  }
  if (!(layer.tip > layer.left && layer.tip < layer.right)) {
    reject("the fault tip is at x = {} m (the layer's bottom reaches from {} to {} m): move the tip between them",
           layer.tip, layer.left, layer.right);
  }
  if (!(std::isfinite(layer.coarsening) && layer.coarsening >= 1.0)) {
    reject("the coarsening is {} (cells grow away from the band): give a number from 1", layer.coarsening);
  }
  if (!(std::isfinite(layer.band_left) && std::isfinite(layer.band_right) && layer.band_left < layer.band_right &&
        layer.band_left < layer.right && layer.band_right > layer.left)) {
    reject("the fine band reaches from x = {} to {} m (it must overlap the layer, {} to {} m): move it",
           layer.band_left, layer.band_right, layer.left, layer.right);
  }
}

template <class Layer>
void require_inside(Layer const& layer, std::vector<double> const& edges) {
  for (double const edge : edges) {
    if (!(edge > layer.left && edge < layer.right)) {
      reject(
          "an edge of a structure is at x = {} m (the surface reaches from {} to {} m): move or narrow the structure",
          edge, layer.left, layer.right);
    }
  }
}

/// lines: x [m] where grid lines must pass, increasing
inline void require_apart(std::vector<double> const& lines, double size) {
  for (std::size_t k = 1; k < lines.size(); ++k) {
    if (lines[k] - lines[k - 1] < size / 4.0) {
      reject(
          "grid lines are needed at x = {} and {} m (closer than a quarter of the element size {} m, the elements "
          "would be slivers): choose smaller elements, or move the structure or the tip",
          lines[k - 1], lines[k], size);
    }
  }
}

/// The element size whose number of elements is nearest to the wanted one.
/// ideal(size): number without rounding to whole cells, falls steadily; count(size): the number itself
/// fine, coarse: sizes [m] that bracket the result
template <class Ideal, class Count>
double size_for_count(int wanted, double fine, double coarse, Ideal const& ideal, Count const& count) {
  for (int k = 0; k < 60; ++k) {
    double const middle = std::sqrt(fine * coarse);
    (ideal(middle) > wanted ? fine : coarse) = middle;
  }
  double const middle = std::sqrt(fine * coarse);
  double best = middle;
  int miss = std::abs(count(best) - wanted);
  constexpr int reach = 500;  // the count jumps by a row or column at a time: look up to 10 % to both sides
  for (int k = 1; k <= 2 * reach; ++k) {
    int const step = (k % 2 == 0 ? 1 : -1) * (k + 1) / 2;
    double const size = middle * (1.0 + 0.1 * step / reach);
    if (int const other = std::abs(count(size) - wanted); other < miss) {
      best = size;
      miss = other;
    }
  }
  return best;
}

}  // namespace scarp::detail

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <cstdlib>

namespace scarp::detail {

/// The element size whose number of elements is nearest to the wanted one.
/// ideal(size): number without rounding to whole cells, falls steadily; count(size): the number itself
/// fine, coarse: sizes [m] that the answer lies between
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

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace scarp {

/// The points that no other beats in cost and error at once, from the cheapest to the most accurate. Points without a
/// finite cost and error never belong to it. Costs whose ratio is below 1 + noise count as equal: of such points the
/// most accurate belongs to the front, and of equal errors the first.
inline std::vector<std::size_t> pareto_front(std::vector<double> const& costs, std::vector<double> const& errors,
                                             double noise = 0.0) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t k) { return !std::isfinite(costs[k]) || !std::isfinite(errors[k]); });
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return errors[a] < errors[b]; });
  std::vector<std::size_t> front;  // the most accurate first, costs falling
  for (std::size_t const k : order) {
    if (!front.empty() && costs[front.back()] <= (1.0 + noise) * costs[k]) continue;
    if (!front.empty() && errors[front.back()] == errors[k]) front.pop_back();
    front.push_back(k);
  }
  std::reverse(front.begin(), front.end());
  return front;
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scarp/core/status.hpp"

namespace scarp {

/// Statistics of a response of all points: how many have which status, and which require most inner steps.
struct PointSurvey {
  /// DEM steps of a point.
  struct Work {
    int point = -1;        ///< number of the point, -1 for none
    long inner_steps = 0;  ///< DEM steps of one response
    friend bool operator==(Work const&, Work const&) = default;
  };
  static constexpr std::size_t max_listed = 5;  ///< length of the list of the slowest points

  std::array<int, 4> statuses{};  ///< number of points by `Status`
  std::vector<Work> slowest{};    ///< most work first, equal ones by number; points without any are left out

  /// Number of points with a status.
  int count(Status status) const { return statuses[static_cast<std::size_t>(status)]; }

  /// Points are added in the order of their numbers.
  void add(int point, Status status, long inner_steps) {
    ++statuses[static_cast<std::size_t>(status)];
    if (inner_steps <= 0 || (slowest.size() == max_listed && inner_steps <= slowest.back().inner_steps)) return;
    auto const after = std::find_if(slowest.begin(), slowest.end(),
                                    [&](Work const& other) { return other.inner_steps < inner_steps; });
    slowest.insert(after, {point, inner_steps});
    if (slowest.size() > max_listed) slowest.pop_back();
  }
};

/// Outcome of a response of all points.
struct [[nodiscard]] ResponseReport {
  Verdict verdict{};     ///< of the worst point
  int worst_point = -1;  ///< that is not acceptable, -1 for none
  long inner_steps = 0;  ///< DEM steps of all points
  PointSurvey points{};  ///< by status, with the slowest
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/observe/surface_point.hpp"

namespace scarp::detail {

/// A point and the place that orders it along a line. [m]
struct Placed {
  double along;
  SurfacePoint point;
};

/// Part of the line that one facet or element covers. [m]
struct Span {
  double from;
  double to;
};

/// Points in the order of their places. Those at equal places become one, their mean; neighbours are joined where a
/// span covers the distance between them.
inline std::vector<SurfacePoint> joined_places(std::vector<Placed> points, std::vector<Span> const& spans) {
  if (points.empty()) return {};
  std::sort(points.begin(), points.end(), [](auto const& a, auto const& b) { return a.along < b.along; });
  double const round_off = 1e-9 * (points.back().along - points.front().along);
  std::vector<double> places;
  std::vector<SurfacePoint> profile;
  for (auto first = points.begin(); first != points.end();) {
    places.push_back(first->along);
    auto const last =
        std::find_if(first, points.end(), [&](auto const& p) { return p.along > places.back() + round_off; });
    SurfacePoint mean{0.0, 0.0, 0.0, false};
    double const together = static_cast<double>(last - first);
    for (; first != last; ++first) {
      mean.x_initial += first->point.x_initial;
      mean.x += first->point.x;
      mean.settlement += first->point.settlement;
    }
    profile.push_back({mean.x_initial / together, mean.x / together, mean.settlement / together, false});
  }
  for (auto const& [from, to] : spans) {
    auto place = std::upper_bound(places.begin(), places.end(), from + round_off);
    for (; place != places.end() && *place <= to + round_off; ++place)
      profile[static_cast<std::size_t>(place - places.begin())].joined = true;
  }
  return profile;
}

/// \throws InputError unless there is a position for every node
inline void require_for_each_node(char const* what, std::size_t positions, std::size_t nodes) {
  if (positions != nodes) {
    refuse("{}: {} are given (the mesh has {} nodes): give one for each node of this mesh", what, positions, nodes);
  }
}

}  // namespace scarp::detail

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/mesh/mid_side_nodes.hpp"

namespace scarp::detail {

/// Positions along the first axis [m] of the corner nodes on some boundary, increasing, each once; those that differ by
/// less than 1e-9 of the boundary's length are one.
template <class Element>
std::vector<double> corners_along(Mesh<Element> const& mesh, std::string_view name) {
  constexpr std::size_t corners = LinearOf<Element>::facet_nodes;
  std::vector<double> places;
  for (auto const& facet : boundary(mesh, name)) {
    for (std::size_t k = 0; k < corners; ++k) places.push_back(mesh.nodes[index(facet[k])](0));
  }
  std::sort(places.begin(), places.end());
  double const same = places.empty() ? 0.0 : 1e-9 * (places.back() - places.front());
  places.erase(std::unique(places.begin(), places.end(), [&](double a, double b) { return b - a <= same; }),
               places.end());
  return places;
}

/// corners: of the surface, increasing [m]; edge: of a structure [m]
inline void require_corner(std::vector<double> const& corners, double edge, double same) {
  auto by_distance = corners;
  std::sort(by_distance.begin(), by_distance.end(),
            [&](double a, double b) { return std::abs(a - edge) < std::abs(b - edge); });
  if (!by_distance.empty() && std::abs(by_distance.front() - edge) <= same) return;
  by_distance.resize(std::min<std::size_t>(by_distance.size(), 2));
  refuse(
      "the edge of a structure at x = {} m is at no corner node of the surface (the nearest are at {} m): move the "
      "edge there, or mesh the ground with a node below the edge",
      edge, listed(by_distance, " and ", "{:.7g}"));
}

}  // namespace scarp::detail

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <concepts>
#include <limits>
#include <string>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/mesh/cells.hpp"

namespace scarp {

/// A place of the ground surface, or of a level inside the ground: where it was, where it is, how far it has settled.
/// [m]
struct SurfacePoint {
  double x_initial;    ///< when the fault began to move
  double x;            ///< now
  double settlement;   ///< since then, positive down
  bool joined = true;  ///< to the point before it, by ground without a gap; without meaning for the first point
};

/// Settlement at a place of a profile, linear between joined points; that of the nearest end outside. NaN inside a gap,
/// where nothing is known, and for an empty profile.
inline double settlement_at(std::vector<SurfacePoint> const& profile, double x_initial) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (profile.empty()) return none;
  if (x_initial <= profile.front().x_initial) return profile.front().settlement;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    auto const& a = profile[k - 1];
    auto const& b = profile[k];
    if (x_initial > b.x_initial) continue;
    if (x_initial == b.x_initial) return b.settlement;
    if (!b.joined) return none;
    double const share = (x_initial - a.x_initial) / (b.x_initial - a.x_initial);
    return a.settlement + share * (b.settlement - a.settlement);
  }
  return profile.back().settlement;
}

namespace detail {

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
    reject("{}: {} are given (the mesh has {} nodes): give one for each node of this mesh", what, positions, nodes);
  }
}

}  // namespace detail

/// Boundaries that make the surface of the ground: "surface", and "footing_base" where has_boundary(name) holds.
template <std::predicate<std::string> HasBoundary>
std::vector<std::string> ground_boundaries(HasBoundary const& has_boundary) {
  std::vector<std::string> names{"surface"};
  if (has_boundary("footing_base")) names.emplace_back("footing_base");
  return names;
}
/// Boundaries of a mesh that make the surface of the ground.
template <class Element>
std::vector<std::string> ground_boundaries(Mesh<Element> const& mesh) {
  return ground_boundaries([&](std::string const& name) { return mesh.boundaries.contains(name); });
}

/// Profile of the ground surface along the first axis, from left to right, made from the facets of boundaries;
/// settlement is along the last axis. Nodes in the middle of facets are points of it too. In space a point is the mean
/// over the nodes of equal x in the mesh, which should have its nodes in lines along the strike.
/// nodes, rest, positions [m]: in the mesh, when the fault began to move, see GroundAtRest, and now
/// \throws InputError for positions of another mesh
template <int Dim>
std::vector<SurfacePoint> surface_profile(std::vector<Vector<Dim>> const& nodes, std::vector<Cells> const& boundaries,
                                          std::vector<Vector<Dim>> const& rest,
                                          std::vector<Vector<Dim>> const& positions) {
  constexpr int up = Dim - 1;
  detail::require_for_each_node("positions at rest", rest.size(), nodes.size());
  detail::require_for_each_node("positions", positions.size(), nodes.size());
  auto const along = [&](int node) { return nodes[detail::index(node)](0); };
  std::vector<int> numbers;
  std::vector<detail::Span> spans;
  for (auto const& facets : boundaries) {
    numbers.insert(numbers.end(), facets.connectivity.begin(), facets.connectivity.end());
    for (auto facet = facets.connectivity.begin(); facet != facets.connectivity.end(); facet += facets.nodes) {
      auto const [first, last] =
          std::minmax_element(facet, facet + facets.nodes, [&](int a, int b) { return along(a) < along(b); });
      spans.push_back({along(*first), along(*last)});
    }
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<detail::Placed> points;
  for (int const node : numbers) {
    auto const n = detail::index(node);
    points.push_back({along(node), {rest[n](0), positions[n](0), rest[n](up) - positions[n](up), false}});
  }
  return detail::joined_places(std::move(points), spans);
}

/// Profile along boundaries of a mesh, given by their names. \throws InputError for unknown ones and for positions of
/// another mesh
template <class Element>
std::vector<SurfacePoint> surface_profile(Mesh<Element> const& mesh, std::vector<Vector<Element::dim>> const& rest,
                                          std::vector<Vector<Element::dim>> const& positions,
                                          std::vector<std::string> const& boundaries) {
  std::vector<Cells> facets;
  for (auto const& name : boundaries) facets.push_back(facets_of(mesh, name));
  return surface_profile(mesh.nodes, facets, rest, positions);
}

/// The whole surface of the ground by ground_boundaries(mesh), also what lies below a footing.
template <class Element>
std::vector<SurfacePoint> surface_profile(Mesh<Element> const& mesh, std::vector<Vector<Element::dim>> const& rest,
                                          std::vector<Vector<Element::dim>> const& positions) {
  return surface_profile(mesh, rest, positions, ground_boundaries(mesh));
}

}  // namespace scarp

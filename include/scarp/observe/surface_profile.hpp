// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <vector>

#include "scarp/mesh/mesh.hpp"
#include "scarp/observe/detail/joined_places.hpp"

namespace scarp {

/// Boundaries that make the surface of the ground: "surface", and "footing_base" where the mesh has it.
template <class Element>
std::vector<std::string> ground_boundaries(Mesh<Element> const& mesh) {
  std::vector<std::string> names{"surface"};
  if (mesh.boundaries.contains("footing_base")) names.emplace_back("footing_base");
  return names;
}

/// Profile of the ground surface along the first axis, from left to right, made from the facets of boundaries;
/// settlement is along the last axis. Nodes in the middle of facets are points of it too. In space a point is the mean
/// over the nodes of equal x in the mesh, which should have its nodes in lines along the strike.
/// rest, positions [m]: of the mesh's nodes when the fault began to move, see GroundAtRest, and now
/// \throws InputError for unknown boundaries and for positions of another mesh
template <class Element>
std::vector<SurfacePoint> surface_profile(Mesh<Element> const& mesh, std::vector<Vector<Element::dim>> const& rest,
                                          std::vector<Vector<Element::dim>> const& positions,
                                          std::vector<std::string> const& boundaries) {
  constexpr int up = Element::dim - 1;
  detail::require_for_each_node("positions at rest", rest.size(), mesh.nodes.size());
  detail::require_for_each_node("positions", positions.size(), mesh.nodes.size());
  auto const along = [&](int node) { return mesh.nodes[detail::index(node)](0); };
  std::vector<int> nodes;
  std::vector<detail::Span> spans;
  for (auto const& name : boundaries) {
    for (auto const& facet : boundary(mesh, name)) {
      nodes.insert(nodes.end(), facet.begin(), facet.end());
      auto const [first, last] =
          std::minmax_element(facet.begin(), facet.end(), [&](int a, int b) { return along(a) < along(b); });
      spans.push_back({along(*first), along(*last)});
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<detail::Placed> points;
  for (int const node : nodes) {
    auto const n = detail::index(node);
    points.push_back({along(node), {rest[n](0), positions[n](0), rest[n](up) - positions[n](up), false}});
  }
  return detail::joined_places(std::move(points), spans);
}

/// Of ground_boundaries(mesh): the whole surface of the ground, also what lies below a footing.
template <class Element>
std::vector<SurfacePoint> surface_profile(Mesh<Element> const& mesh, std::vector<Vector<Element::dim>> const& rest,
                                          std::vector<Vector<Element::dim>> const& positions) {
  return surface_profile(mesh, rest, positions, ground_boundaries(mesh));
}

}  // namespace scarp

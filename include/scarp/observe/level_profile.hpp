// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <vector>

#include "scarp/mesh/mesh.hpp"
#include "scarp/observe/surface_profile.hpp"

namespace scarp {

namespace detail {

/// visit(a, b) for the straight parts of an element's sides, as node numbers of the mesh in increasing order: two parts
/// where a side has a node in its middle.
template <class Element, class Visit>
void for_each_edge(std::array<int, Element::nodes> const& nodes, Visit const& visit) {
  auto const part = [&](int a, int b) { visit(std::min(a, b), std::max(a, b)); };
  for (auto const& facet : Element::facets()) {
    int const first = nodes[index(facet[0])];
    int const last = nodes[index(facet[1])];
    if constexpr (Element::facet_nodes == 3) {
      int const middle = nodes[index(facet[2])];
      part(first, middle);
      part(middle, last);
    } else {
      part(first, last);
    }
  }
}

}  // namespace detail

/// Where a level line crosses the sides of the elements, from left to right, as a profile inside the ground. Settlement
/// is linear along sides, on each half of a side with a node in its middle.
/// height [m]: of the line where the nodes were at rest; along the bottom it crosses nothing
/// rest, positions [m]: of the mesh's nodes when the fault began to move, see GroundAtRest, and now
/// \throws InputError for positions of another mesh
template <class Element>
  requires(Element::dim == 2)
std::vector<SurfacePoint> level_profile(Mesh<Element> const& mesh, std::vector<Vector<2>> const& rest,
                                        std::vector<Vector<2>> const& positions, double height) {
  static_assert(Element::facet_nodes <= 3, "sides are lines of two or three nodes");
  detail::require_for_each_node("positions at rest", rest.size(), mesh.nodes.size());
  detail::require_for_each_node("positions", positions.size(), mesh.nodes.size());
  std::vector<detail::Placed> crossings;
  std::vector<detail::Span> spans;
  for (auto const& nodes : mesh.elements) {
    std::size_t const before = crossings.size();
    detail::for_each_edge<Element>(nodes, [&](int a, int b) {
      auto const i = detail::index(a);
      auto const j = detail::index(b);
      double const from = rest[i].y() - height;
      double const to = rest[j].y() - height;
      if ((from >= 0.0) == (to >= 0.0))
        return;  // a node on the line counts as above it: no crossing is lost or found twice
      double const part = from / (from - to);
      Vector<2> const was = rest[i] + part * (rest[j] - rest[i]);
      Vector<2> const is = positions[i] + part * (positions[j] - positions[i]);
      crossings.push_back({was.x(), {was.x(), is.x(), was.y() - is.y(), false}});
    });
    if (crossings.size() == before) continue;
    detail::Span span{crossings.back().along, crossings.back().along};
    for (std::size_t k = before; k < crossings.size(); ++k) {
      span.from = std::min(span.from, crossings[k].along);
      span.to = std::max(span.to, crossings[k].along);
    }
    spans.push_back(span);
  }
  return detail::joined_places(std::move(crossings), spans);
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <vector>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// The sides that only one element has: the outline of the mesh, and both faces of every crack in it. In the order of
/// the elements.
template <ReferenceElement Element>
std::vector<MeshSide<Element>> outer_facets(Mesh<Element> const& mesh) {
  auto const sides = detail::sorted_sides(mesh);
  std::vector<MeshSide<Element>> outer;
  std::ranges::copy_if(sides, std::back_inserter(outer),
                       [&](auto const& side) { return detail::sides_with(sides, side.nodes).size() == 1; });
  std::ranges::stable_sort(outer, {}, &MeshSide<Element>::element);
  return outer;
}

/// The facets of a plane mesh's boundary as straight pieces between neighbouring nodes, in the direction of the
/// facets; one with a node in its middle gives two.
/// \throws InputError for an unknown name, listing the known ones
template <class Element>
  requires(Element::dim == 2)
std::vector<std::array<int, 2>> straight_facets(Mesh<Element> const& mesh, std::string_view name) {
  std::vector<std::array<int, 2>> pieces;
  for (auto const& facet : boundary(mesh, name)) {
    if constexpr (Element::facet_nodes == 2) {
      pieces.push_back(facet);
    } else {
      static_assert(Element::facet_nodes == 3, "facets with one node in the middle at most");
      pieces.push_back({facet[0], facet[2]});
      pieces.push_back({facet[2], facet[1]});
    }
  }
  return pieces;
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// The side of an element.
template <ReferenceElement Element>
struct ElementSide {
  int element = 0;                                ///< number of the element
  std::array<int, Element::facet_nodes> nodes{};  ///< in the sense of the outward normal
};

/// The sides that only one element has: the outline of the mesh, and both faces of every crack in it. In the order of
/// the elements.
template <ReferenceElement Element>
std::vector<ElementSide<Element>> outer_facets(Mesh<Element> const& mesh) {
  using Nodes = std::array<int, Element::facet_nodes>;
  struct Entry {
    Nodes key;
    ElementSide<Element> side;
  };
  std::vector<Entry> entries;
  for (int e = 0; e < detail::count(mesh.elements); ++e) {
    for (auto facet : Element::facets()) {
      for (int& node : facet) node = mesh.elements[detail::index(e)][detail::index(node)];
      Nodes key = facet;
      std::sort(key.begin(), key.end());
      entries.push_back({key, {e, facet}});
    }
  }
  std::stable_sort(entries.begin(), entries.end(), [](Entry const& a, Entry const& b) { return a.key < b.key; });
  std::vector<ElementSide<Element>> outer;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    bool const like_last = k > 0 && entries[k].key == entries[k - 1].key;
    bool const like_next = k + 1 < entries.size() && entries[k].key == entries[k + 1].key;
    if (!like_last && !like_next) outer.push_back(entries[k].side);
  }
  std::stable_sort(outer.begin(), outer.end(), [](auto const& a, auto const& b) { return a.element < b.element; });
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

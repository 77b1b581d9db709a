// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <vector>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// The side of an element.
template <ReferenceElement Element>
struct ElementSide {
  int element = 0;
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

}  // namespace scarp

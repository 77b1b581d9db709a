// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <set>

#include "scarp/mesh/detail/place_index.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Adds a part to a mesh. Nodes at the same place, to 1e-9 of the larger one's extent, become one; regions and
/// boundaries of the same name are united. Nodes and elements of the mesh keep their numbers, the part's follow in its
/// order. Sides must
/// fit: a node of one in the middle of a side of the other is not seen here (see require_no_hanging_nodes).
/// \throws InputError for an invalid part
template <ReferenceElement Element>
void join(Mesh<Element>& mesh, Mesh<Element> const& part) {
  constexpr int dim = Element::dim;
  validate(part);
  double const same = 1e-9 * std::max(extent<dim>(mesh.nodes), extent<dim>(part.nodes));
  detail::PlaceIndex<dim> places(4.0 * same);
  for (int n = 0; n < detail::count(mesh.nodes); ++n) places.add(mesh.nodes[detail::index(n)], n);
  std::vector<int> number_of;
  for (auto const& node : part.nodes) {
    int const there = places.at(node, same);
    number_of.push_back(there >= 0 ? there : detail::count(mesh.nodes));
    if (there < 0) mesh.nodes.push_back(node);
  }
  auto const renumbered = [&](auto cell) {
    for (int& node : cell) node = number_of[detail::index(node)];
    return cell;
  };
  std::vector<int> region_of;
  for (auto const& name : part.regions) {
    auto const found = std::find(mesh.regions.begin(), mesh.regions.end(), name);
    region_of.push_back(static_cast<int>(found - mesh.regions.begin()));
    if (found == mesh.regions.end()) mesh.regions.push_back(name);
  }
  for (int e = 0; e < detail::count(part.elements); ++e) {
    mesh.elements.push_back(renumbered(part.elements[detail::index(e)]));
    mesh.element_region.push_back(region_of[detail::index(part.element_region[detail::index(e)])]);
  }
  for (auto const& [name, facets] : part.boundaries) {
    auto& united = mesh.boundaries[name];
    std::set<std::array<int, Element::facet_nodes>> known;
    for (auto const& facet : united) known.insert(detail::sorted_nodes(facet));
    for (auto const& facet : facets) {
      if (known.insert(detail::sorted_nodes(renumbered(facet))).second) united.push_back(renumbered(facet));
    }
  }
}

}  // namespace scarp

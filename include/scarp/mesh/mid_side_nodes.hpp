// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <map>
#include <utility>

#include "scarp/element/mid_sides.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

namespace detail {

template <class Element>
struct CornerElement {
  using Type = Element;
};
template <HasMidSides Element>
struct CornerElement<Element> {
  using Type = typename Element::Linear;
};

/// For each facet of a mesh, by its sorted nodes: an element that has it, and which of that element's facets it is.
template <class Element>
std::map<std::array<int, Element::facet_nodes>, std::pair<int, int>> facet_owners(Mesh<Element> const& mesh) {
  std::map<std::array<int, Element::facet_nodes>, std::pair<int, int>> owners;
  for (int e = 0; e < count(mesh.elements); ++e) {
    for (int f = 0; f < count(Element::facets()); ++f) {
      auto facet = Element::facets()[index(f)];
      for (int& node : facet) {
        node = mesh.elements[index(e)][index(node)];
      }
      std::sort(facet.begin(), facet.end());
      owners.try_emplace(facet, e, f);
    }
  }
  return owners;
}

/// The k-th facet of the quadratic element starts with the corners of the k-th facet of the linear one.
template <class Element>
constexpr bool facets_agree() {
  using Linear = typename Element::Linear;
  for (std::size_t f = 0; f < Linear::facets().size(); ++f) {
    for (std::size_t a = 0; a < Linear::facets()[f].size(); ++a) {
      if (Element::facets()[f][a] != Linear::facets()[f][a]) {
        return false;
      }
    }
  }
  return Linear::facets().size() == Element::facets().size();
}

}  // namespace detail

/// The element without the nodes on its sides; a straight element itself.
template <class Element>
using LinearOf = typename detail::CornerElement<Element>::Type;

/// The mesh with one more node in the middle of every edge, shared by the elements there; edges stay straight. Corners
/// keep their numbers, regions and boundaries their names.
/// \throws InputError for an invalid mesh
template <ReferenceElement Element>
  requires HasMidSides<Element> Mesh<Element> with_mid_side_nodes(Mesh<typename Element::Linear> const& linear) {
    static_assert(detail::facets_agree<Element>(), "the facets of both elements must be in the same order");
    validate(linear);
    Mesh<Element> mesh{linear.nodes, {}, linear.element_region, linear.regions, {}};
    std::map<std::pair<int, int>, int> middles;
    for (auto const& corners : linear.elements) {
      std::array<int, Element::nodes> element{};
      std::copy(corners.begin(), corners.end(), element.begin());
      auto next = element.begin() + corners.size();
      for (auto const& [a, b] : Element::mid_sides()) {
        std::pair<int, int> const edge = std::minmax({corners[detail::index(a)], corners[detail::index(b)]});
        auto const [place, is_new] = middles.try_emplace(edge, detail::count(mesh.nodes));
        if (is_new) {
          mesh.nodes.push_back((linear.nodes[detail::index(edge.first)] + linear.nodes[detail::index(edge.second)]) /
                               2.0);
        }
        *next++ = place->second;
      }
      mesh.elements.push_back(element);
    }
    auto const owners = detail::facet_owners(linear);
    for (auto const& [name, facets] : linear.boundaries) {
      auto& quadratic = mesh.boundaries[name];
      for (auto facet : facets) {
        std::sort(facet.begin(), facet.end());
        auto const [e, f] = owners.at(facet);
        auto nodes = Element::facets()[detail::index(f)];
        for (int& node : nodes) {
          node = mesh.elements[detail::index(e)][detail::index(node)];
        }
        quadratic.push_back(nodes);
      }
    }
    return mesh;
  }

/// A mesh of any element from its corners' mesh.
/// \throws InputError for an invalid mesh
template <ReferenceElement Element>
Mesh<Element> with_nodes_of(Mesh<LinearOf<Element>> linear) {
  if constexpr (HasMidSides<Element>) {
    return with_mid_side_nodes<Element>(linear);
  } else {
    validate(linear);
    return linear;
  }
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "scarp/element/mid_sides.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

namespace detail {

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

/// Gives a mesh the boundaries of the corners' mesh that it was made from.
template <class Element>
void name_boundaries(Mesh<typename Element::Linear> const& linear, Mesh<Element>& mesh) {
  auto const owners = facet_owners(linear);
  for (auto const& [name, facets] : linear.boundaries) {
    auto& named = mesh.boundaries[name];
    for (auto facet : facets) {
      std::sort(facet.begin(), facet.end());
      auto const [e, f] = owners.at(facet);
      auto nodes = Element::facets()[index(f)];
      for (int& node : nodes) {
        node = mesh.elements[index(e)][index(node)];
      }
      named.push_back(nodes);
    }
  }
}

}  // namespace detail

/// The mesh of the corners alone, in their order; regions and boundaries keep their names.
template <ReferenceElement Element>
Mesh<LinearOf<Element>> corner_mesh(Mesh<Element> const& mesh) {
  using Linear = LinearOf<Element>;
  if constexpr (std::is_same_v<Linear, Element>) {
    return mesh;
  } else {
    static_assert(detail::facets_agree<Element>(), "the facets of both elements must be in the same order");
    Mesh<Linear> linear{{}, {}, mesh.element_region, mesh.regions, {}};
    std::vector<int> number_of(mesh.nodes.size(), -1);
    for (auto const& element : mesh.elements) {
      for (std::size_t a = 0; a < Linear::nodes; ++a) number_of[detail::index(element[a])] = 0;
    }
    for (std::size_t n = 0; n < number_of.size(); ++n) {
      if (number_of[n] < 0) continue;
      number_of[n] = detail::count(linear.nodes);
      linear.nodes.push_back(mesh.nodes[n]);
    }
    auto const corners_of = [&](auto const& all, auto corners) {
      for (std::size_t a = 0; a < corners.size(); ++a) corners[a] = number_of[detail::index(all[a])];
      return corners;
    };
    for (auto const& element : mesh.elements) {
      linear.elements.push_back(corners_of(element, std::array<int, Linear::nodes>{}));
    }
    for (auto const& [name, facets] : mesh.boundaries) {
      auto& named = linear.boundaries[name];
      for (auto const& facet : facets) named.push_back(corners_of(facet, std::array<int, Linear::facet_nodes>{}));
    }
    return linear;
  }
}

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
    detail::name_boundaries(linear, mesh);
    return mesh;
  }

/// The mesh with the further nodes of an element at its node_places(), each once: elements share a node that has
/// the same weights of the same corners. Edges stay straight. Corners keep their numbers, regions and boundaries their
/// names.
/// \throws InputError for an invalid mesh, and for an element whose first nodes are not the corners of `Linear`
template <ReferenceElement Element>
  requires PlacesNodes<Element> Mesh<Element> with_placed_nodes(Mesh<typename Element::Linear> const& linear) {
    using Linear = typename Element::Linear;
    static_assert(detail::facets_agree<Element>(), "the facets of both elements must be in the same order");
    validate(linear);
    Mesh<Element> mesh{linear.nodes, {}, linear.element_region, linear.regions, {}};
    std::array<ShapeValues<Linear>, Element::nodes> weights;
    for (int a = 0; a < Element::nodes; ++a) {
      weights[detail::index(a)] = Linear::shape(Element::node_places()[detail::index(a)]);
      if (a < Linear::nodes && !weights[detail::index(a)].isApprox(ShapeValues<Linear>::Unit(a), 1e-12)) {
        reject("node {} of an element is not at the corner of this number (corners come first): correct node_places()",
               a);
      }
    }
    constexpr double parts = 1e6;  // two places of one element are further apart than that
    std::map<std::vector<std::pair<int, long>>, int> placed;
    for (auto const& corners : linear.elements) {
      std::array<int, Element::nodes> element{};
      std::copy(corners.begin(), corners.end(), element.begin());
      for (std::size_t a = corners.size(); a < element.size(); ++a) {
        std::vector<std::pair<int, long>> key;
        Vector<Element::dim> place = Vector<Element::dim>::Zero();
        for (std::size_t c = 0; c < corners.size(); ++c) {
          double const weight = weights[a](static_cast<Eigen::Index>(c));
          place += weight * linear.nodes[detail::index(corners[c])];
          if (long const rounded = std::lround(weight * parts); rounded != 0) key.emplace_back(corners[c], rounded);
        }
        std::sort(key.begin(), key.end());
        auto const [found, is_new] = placed.try_emplace(key, detail::count(mesh.nodes));
        if (is_new) mesh.nodes.push_back(place);
        element[a] = found->second;
      }
      mesh.elements.push_back(element);
    }
    detail::name_boundaries(linear, mesh);
    return mesh;
  }

/// A mesh of any element from its corners' mesh.
/// \throws InputError for an invalid mesh
template <ReferenceElement Element>
Mesh<Element> with_nodes_of(Mesh<LinearOf<Element>> linear) {
  if constexpr (HasMidSides<Element>) {
    return with_mid_side_nodes<Element>(linear);
  } else if constexpr (PlacesNodes<Element>) {
    return with_placed_nodes<Element>(linear);
  } else {
    validate(linear);
    return linear;
  }
}

}  // namespace scarp

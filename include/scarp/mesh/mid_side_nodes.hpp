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

/// The k-th facet of the quadratic element starts with the corners of the k-th facet of the linear one.
template <class Element>
constexpr bool facets_agree() {
  return std::ranges::equal(Element::Linear::facets(), Element::facets(), [](auto const& corners, auto const& all) {
    return std::equal(corners.begin(), corners.end(), all.begin());
  });
}

/// Gives a mesh the boundaries of the corners' mesh that it was made from.
template <class Element>
void name_boundaries(Mesh<typename Element::Linear> const& linear, Mesh<Element>& mesh) {
  auto const sides = sorted_sides(linear);
  for (auto const& [name, facets] : linear.boundaries) {
    auto& named = mesh.boundaries[name];
    for (auto const& facet : facets) {
      auto const& side = sides_with(sides, facet).front();
      named.push_back(side_nodes(mesh, side.element, side.facet));
    }
  }
}

/// Shares of the corners in the places of all nodes: their shape functions there.
/// \throws InputError for an element whose first nodes are not the corners of `Linear`
template <class Element>
std::array<ShapeValues<typename Element::Linear>, Element::nodes> corner_shares() {
  using Linear = typename Element::Linear;
  std::array<ShapeValues<Linear>, Element::nodes> shares;
  for (int a = 0; a < Element::nodes; ++a) {
    auto const corner = [](int number) -> ShapeValues<Linear> { return ShapeValues<Linear>::Unit(number); };
    if constexpr (HasMidSides<Element>) {
      auto const [b, c] = a < Linear::nodes ? std::array<int, 2>{a, a}
                                            : std::array<int, 2>(Element::mid_sides()[index(a - Linear::nodes)]);
      shares[index(a)] = (corner(b) + corner(c)) / 2.0;
    } else {
      shares[index(a)] = Linear::shape(Element::node_places()[index(a)]);
      if (a < Linear::nodes && !shares[index(a)].isApprox(corner(a), 1e-12)) {
        reject("node {} of an element is not at the corner of this number (corners come first): correct node_places()",
               a);
      }
    }
  }
  return shares;
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

/// A mesh of any element from its corners' mesh: with the further nodes of the element in the middles of edges or at
/// its node_places(), each once, since elements share a node that has the same shares of the same corners. Edges stay
/// straight. Corners keep their numbers, regions and boundaries their names.
/// \throws InputError for an invalid mesh, and for an element whose first nodes are not the corners of `Linear`
template <ReferenceElement Element>
Mesh<Element> with_nodes_of(Mesh<LinearOf<Element>> linear) {
  validate(linear);
  if constexpr (std::is_same_v<LinearOf<Element>, Element>) {
    return linear;
  } else {
    static_assert(detail::facets_agree<Element>(), "the facets of both elements must be in the same order");
    auto const shares = detail::corner_shares<Element>();
    Mesh<Element> mesh{linear.nodes, {}, linear.element_region, linear.regions, {}};
    constexpr double parts = 1e6;  // two places of one element are further apart than that
    using Shares = std::array<std::pair<int, long>, LinearOf<Element>::nodes>;  // of corners by their numbers, sorted
    std::map<Shares, int> placed;
    for (auto const& corners : linear.elements) {
      std::array<int, Element::nodes> element{};
      std::copy(corners.begin(), corners.end(), element.begin());
      for (std::size_t a = corners.size(); a < element.size(); ++a) {
        Shares key{};
        Vector<Element::dim> place = Vector<Element::dim>::Zero();
        for (std::size_t c = 0; c < corners.size(); ++c) {
          double const share = shares[a](static_cast<Eigen::Index>(c));
          place += share * linear.nodes[detail::index(corners[c])];
          if (long const rounded = std::lround(share * parts); rounded != 0) key[c] = {corners[c], rounded};
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
}

}  // namespace scarp

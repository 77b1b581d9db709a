// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/element/map.hpp"
#include "scarp/mesh/windings.hpp"

namespace scarp {

/// Nodes, elements of one kind, the regions they belong to and named sets of element sides. SI units.
template <CheckedElement Element>
struct Mesh {
  using ElementType = Element;              ///< shape functions and nodes of one element
  static constexpr int dim = Element::dim;  ///< of space

  std::vector<Vector<dim>> nodes;                         ///< [m]
  std::vector<std::array<int, Element::nodes>> elements;  ///< node numbers from 0, in the element's own order
  std::vector<int> element_region;                        ///< for each element a number into `regions`
  std::vector<std::string> regions;                       ///< names; elements refer to them by number
  /// Sides of elements by the name of their set, as node numbers of the mesh: corners in turn, from any and either way
  /// round, then the nodes between them, as `Element::facets()` has them.
  std::map<std::string, std::vector<std::array<int, Element::facet_nodes>>> boundaries;
};

/// A side of an element of a mesh.
template <class Element>
struct MeshSide {
  std::array<int, Element::facet_nodes> nodes;   ///< in the sense of the outward normal
  std::array<int, Element::facet_nodes> sorted;  ///< the same nodes
  int element;                                   ///< number of the element
  int facet;                                     ///< number of the side among `Element::facets()`
};

namespace detail {

template <class Element>
void validate_sizes(Mesh<Element> const& mesh) {
  if (mesh.nodes.empty() || mesh.elements.empty()) {
    reject("the mesh has {} nodes and {} elements (it is empty): check the generator or the file it came from",
           mesh.nodes.size(), mesh.elements.size());
  }
  if (mesh.element_region.size() != mesh.elements.size()) {
    reject("the mesh has {} elements but {} region numbers (each element needs one): fill element_region",
           mesh.elements.size(), mesh.element_region.size());
  }
  for (auto name = mesh.regions.begin(); name != mesh.regions.end(); ++name) {
    if (std::find(mesh.regions.begin(), name, *name) != name)
      reject("the mesh has two regions '{}' (materials are found by name): give each a name of its own", *name);
  }
  for (int e = 0; e < count(mesh.elements); ++e) {
    int const region = mesh.element_region[index(e)];
    if (region < 0 || region >= count(mesh.regions)) {
      reject("element {} has the region number {} (the mesh names {} regions: {}): name it in regions", e, region,
             mesh.regions.size(), listed(mesh.regions));
    }
  }
}

template <class Element>
void validate_nodes(Mesh<Element> const& mesh) {
  std::vector<bool> used(mesh.nodes.size(), false);
  for (int e = 0; e < count(mesh.elements); ++e) {
    for (int const node : mesh.elements[index(e)]) {
      if (node < 0 || node >= count(mesh.nodes)) {
        reject("element {} names node {} (the mesh has nodes 0 to {}): check the numbering", e, node,
               mesh.nodes.size() - 1);
      }
      used[index(node)] = true;
    }
  }
  for (int n = 0; n < count(mesh.nodes); ++n) {
    if (!mesh.nodes[index(n)].allFinite()) {
      reject("node {} is at ({}) (not a finite position): check the coordinates", n, listed(mesh.nodes[index(n)]));
    }
    if (!used[index(n)]) {
      reject("node {} at ({}) belongs to no element (its equations would be singular): remove it", n,
             listed(mesh.nodes[index(n)]));
    }
  }
}

/// The Jacobian at a point of an element where it is not positive, if there is such a point. A volume below 1e-10 of
/// the element's extent to the power dim counts as zero: it is round-off of flat elements.
template <class Element>
std::optional<double> bad_jacobian(Mesh<Element> const& mesh, int element) {
  auto const rows = corners<Element, Element::dim>(mesh.elements[index(element)], mesh.nodes);
  double const extent = (rows.colwise().maxCoeff() - rows.colwise().minCoeff()).maxCoeff();
  for (auto const& point : Element::quadrature()) {
    double const determinant = measure<Element, Element::dim>(rows, point.xi);
    if (!(determinant > 1e-10 * std::pow(extent, Element::dim))) return determinant;
  }
  return std::nullopt;
}

template <class Element>
void validate_jacobians(Mesh<Element> const& mesh) {
  for (int e = 0; e < count(mesh.elements); ++e) {
    if (auto const determinant = bad_jacobian(mesh, e)) {
      reject(
          "element {} (nodes {}) has the Jacobian {} m^{} (flat, or its nodes run the wrong way round): "
          "reorder or move its nodes",
          e, listed(mesh.elements[index(e)]), *determinant, Element::dim);
    }
  }
}

template <class Nodes>
Nodes sorted_nodes(Nodes nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Numbers of the nodes of one of an element's facets, in the sense of the outward normal.
template <class Element>
std::array<int, Element::facet_nodes> side_nodes(Mesh<Element> const& mesh, int element, int facet) {
  auto nodes = Element::facets()[index(facet)];
  for (int& node : nodes) node = mesh.elements[index(element)][index(node)];
  return nodes;
}

/// The sides of all elements by their sorted nodes; of those with the same nodes the first element's comes first.
template <class Element>
std::vector<MeshSide<Element>> sorted_sides(Mesh<Element> const& mesh) {
  std::vector<MeshSide<Element>> sides;
  for (int e = 0; e < count(mesh.elements); ++e) {
    for (int f = 0; f < count(Element::facets()); ++f) {
      auto const nodes = side_nodes(mesh, e, f);
      sides.push_back({nodes, sorted_nodes(nodes), e, f});
    }
  }
  std::ranges::stable_sort(sides, {}, &MeshSide<Element>::sorted);
  return sides;
}

/// Those of the sorted sides that have these nodes, in whatever order: none, one or, between two elements, two.
template <class Element>
std::span<MeshSide<Element> const> sides_with(std::vector<MeshSide<Element>> const& sides,
                                              decltype(MeshSide<Element>::nodes) const& nodes) {
  auto const sorted = sorted_nodes(nodes);
  auto const first = std::ranges::lower_bound(sides, sorted, {}, &MeshSide<Element>::sorted);
  return {first, std::ranges::upper_bound(sides, sorted, {}, &MeshSide<Element>::sorted)};
}

/// Two elements that lie on the same side of a facet, by the sorted sides, if there are such.
template <class Element>
std::optional<std::pair<int, int>> overlapping_elements(std::vector<MeshSide<Element>> const& sides) {
  for (std::size_t k = 1; k < sides.size(); ++k) {
    auto const& one = sides[k - 1];
    auto const& other = sides[k];
    if (one.sorted != other.sorted) continue;
    bool const third = k > 1 && sides[k - 2].sorted == other.sorted;
    if (third || same_winding<typename Element::Facet>(one.nodes, other.nodes))
      return std::pair{one.element, other.element};
  }
  return std::nullopt;
}

template <class Element>
void validate_boundaries(Mesh<Element> const& mesh) {
  auto const sides = sorted_sides(mesh);
  if (auto const both = overlapping_elements(sides))
    reject("elements {} and {} lie on the same side of a facet (they overlap): remove one of them", both->first,
           both->second);
  for (auto const& [name, facets] : mesh.boundaries) {
    std::set<std::array<int, Element::facet_nodes>> known;
    for (auto const& facet : facets) {
      auto const found = sides_with(sides, facet);
      if (found.empty()) {
        reject("boundary '{}' holds the facet ({}) (no element has this side): check its node numbers", name,
               listed(facet));
      }
      if (!is_same_side<typename Element::Facet>(facet, found.front().nodes)) {
        reject("boundary '{}' holds the facet ({}) (its element has these nodes in the order {}): reorder them", name,
               listed(facet), listed(found.front().nodes));
      }
      if (!known.insert(found.front().sorted).second) {
        reject("boundary '{}' holds the facet ({}) twice (loads on it would double): remove one", name, listed(facet));
      }
    }
  }
}

}  // namespace detail

/// \throws InputError for an empty mesh, wrong node or region numbers, positions that are not finite, unused nodes,
/// elements without positive volume, two elements on the same side of a facet, boundary facets that are no element's
/// side, and such that are there twice
template <class Element>
SCARP_EXPORT void validate(Mesh<Element> const& mesh) {
  detail::validate_sizes(mesh);
  detail::validate_nodes(mesh);
  detail::validate_jacobians(mesh);
  detail::validate_boundaries(mesh);
}

/// The facets of a boundary; all who load, hold or measure one find it by this.
/// \throws InputError for an unknown name, listing the known ones, and for a boundary without facets
template <class Element>
std::vector<std::array<int, Element::facet_nodes>> const& boundary(Mesh<Element> const& mesh, std::string_view name) {
  auto const found = mesh.boundaries.find(std::string(name));
  if (found == mesh.boundaries.end()) {
    std::vector<std::string> known;
    for (auto const& entry : mesh.boundaries) {
      known.push_back(entry.first);
    }
    reject("there is no boundary '{}' (the mesh has: {}): use one of these names", name, listed(known));
  }
  if (found->second.empty()) {
    reject(
        "the boundary '{}' has no facets (nothing can be held, loaded or measured on it): put sides of elements into "
        "it, or "
        "take another",
        name);
  }
  return found->second;
}

/// Numbers of the nodes on a boundary, sorted, each once.
/// \throws InputError as boundary() does
template <class Element>
std::vector<int> boundary_nodes(Mesh<Element> const& mesh, std::string_view name) {
  std::vector<int> numbers;
  for (auto const& facet : boundary(mesh, name)) {
    numbers.insert(numbers.end(), facet.begin(), facet.end());
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

namespace detail {
/// \throws InputError for an unknown name, listing the known ones
inline int region_among(std::vector<std::string> const& regions, std::string_view name) {
  auto const found = std::find(regions.begin(), regions.end(), name);
  if (found == regions.end()) {
    reject("there is no region '{}' (the mesh has: {}): use one of these names", name, listed(regions));
  }
  return static_cast<int>(found - regions.begin());
}
}  // namespace detail

/// \throws InputError for an unknown name, listing the known ones
template <class Element>
int region_number(Mesh<Element> const& mesh, std::string_view name) {
  return detail::region_among(mesh.regions, name);
}

/// Area of a region [m2], in 3D its volume [m3].
/// places [m]: of all nodes, such as mesh.nodes
/// \throws InputError for an unknown region
template <class Element>
double region_area(Mesh<Element> const& mesh, std::string_view region,
                   std::vector<Vector<Element::dim>> const& places) {
  int const number = region_number(mesh, region);
  double area = 0.0;
  for (int e = 0; e < detail::count(mesh.elements); ++e) {
    if (mesh.element_region[detail::index(e)] != number) continue;
    auto const rows = corners<Element, Element::dim>(mesh.elements[detail::index(e)], places);
    for (auto const& point : Element::quadrature())
      area += point.weight * measure<Element, Element::dim>(rows, point.xi);
  }
  return area;
}

/// Extent of nodes along the axis where they reach farthest [m].
template <int Dim>
double extent(std::vector<Vector<Dim>> const& nodes) {
  if (nodes.empty()) return 0.0;
  Vector<Dim> low = nodes.front();
  Vector<Dim> high = nodes.front();
  for (auto const& node : nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  return (high - low).maxCoeff();
}

}  // namespace scarp

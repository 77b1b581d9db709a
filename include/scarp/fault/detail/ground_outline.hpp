// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/mesh/facets.hpp"

namespace scarp::detail {

/// A plane across an axis that a boundary lies in, at one end of the soil.
struct OutlinePart {
  std::string name;
  int axis;
  bool upper;
};

/// What bounds the soil; "footing_base" belongs to it where a mesh has one.
template <class Element>
std::vector<OutlinePart> outline_parts(Mesh<Element> const& mesh) {
  constexpr int up = Element::dim - 1;
  std::vector<OutlinePart> parts{{"left", 0, false}, {"right", 0, true}, {"bottom", up, false}, {"surface", up, true}};
  if constexpr (Element::dim == 3) {
    parts.push_back({"front", 1, false});
    parts.push_back({"back", 1, true});
  }
  if (mesh.boundaries.count("footing_base") != 0) parts.push_back({"footing_base", up, true});
  return parts;
}

/// Lowest and highest coordinates of a region's nodes [m].
template <class Element>
std::array<Vector<Element::dim>, 2> extents_of(Mesh<Element> const& mesh, int region) {
  std::array<Vector<Element::dim>, 2> ends;
  bool first = true;
  for (int e = 0; e < count(mesh.elements); ++e) {
    if (mesh.element_region[index(e)] != region) continue;
    for (int const node : mesh.elements[index(e)]) {
      auto const& place = mesh.nodes[index(node)];
      ends[0] = first ? place : Vector<Element::dim>(ends[0].cwiseMin(place));
      ends[1] = first ? place : Vector<Element::dim>(ends[1].cwiseMax(place));
      first = false;
    }
  }
  return ends;
}

/// Where the soil ends, to 1e-6 of its extent: files with seven digits pass.
template <class Element>
struct SoilEnds {
  std::array<Vector<Element::dim>, 2> ends;
  double same = 1e-6 * (ends[1] - ends[0]).maxCoeff();

  explicit SoilEnds(Mesh<Element> const& mesh) : ends(extents_of(mesh, region_number(mesh, "soil"))) {}
  double level(OutlinePart const& part) const { return ends[part.upper ? 1 : 0](part.axis); }
  bool has(OutlinePart const& part, Vector<Element::dim> const& place) const {
    return std::abs(place(part.axis) - level(part)) <= same;
  }
};

template <class Element>
void require_straight_outline(Mesh<Element> const& mesh) {
  SoilEnds<Element> const ends(mesh);
  for (auto const& part : outline_parts(mesh)) {
    for (int const node : boundary_nodes(mesh, part.name)) {
      auto const& place = mesh.nodes[index(node)];
      if (ends.has(part, place)) continue;
      reject(
          "the boundary '{}' passes through ({}), but the soil {} at {} = {} m (it must be straight, level below and "
          "above, upright at the ends): mesh a layer with level surface and bottom and upright ends",
          part.name, listed(place), part.upper ? "ends" : "begins", "xyz"[part.axis], ends.level(part));
    }
  }
}

/// A sound outline: every side of the soil that no other element has is in one part, once.
template <class Element>
void require_closed_outline(Mesh<Element> const& mesh) {
  using Side = std::array<int, Element::facet_nodes>;
  auto const middle = [&](Side const& side) {
    Vector<Element::dim> sum = Vector<Element::dim>::Zero();
    for (int const node : side) sum += mesh.nodes[index(node)] / static_cast<double>(side.size());
    return sum;
  };
  std::map<Side, std::string> part_of;
  std::vector<std::string> names;
  for (auto const& part : outline_parts(mesh)) {
    names.push_back(part.name);
    for (auto const& side : boundary(mesh, part.name)) {
      auto const [found, is_new] = part_of.try_emplace(sorted_nodes(side), part.name);
      if (is_new) continue;
      reject(
          "the side with its middle at ({}) is in '{}' and in '{}' (loads and motions would count twice): put it in "
          "one physical group, once",
          listed(middle(side)), found->second, part.name);
    }
  }
  int const soil = region_number(mesh, "soil");
  int open = 0;
  Side first{};
  for (auto const& side : outer_facets(mesh)) {
    if (mesh.element_region[index(side.element)] != soil) continue;
    if (part_of.erase(sorted_nodes(side.nodes)) == 0 && ++open == 1) first = side.nodes;
  }
  if (open > 0) {
    reject(
        "the side with its middle at ({}) bounds the soil but is in none of {} ({} such sides: a hole, a crack or a "
        "part "
        "of the outline without physical group): close it or put it in its group",
        listed(middle(first)), listed(names), open);
  }
  for (auto const& [side, name] : part_of) {
    if (name == "footing_base") continue;  // a block stands on it
    reject(
        "the side with its middle at ({}) is in '{}' but lies between two elements (a boundary bounds the soil): take "
        "it "
        "out of the group{}",
        listed(middle(side)), name, name == "surface" ? ", below a footing into 'footing_base'" : "");
  }
}

}  // namespace scarp::detail

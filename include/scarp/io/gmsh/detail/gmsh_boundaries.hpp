// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/io/gmsh/detail/gmsh_kinds.hpp"
#include "scarp/io/gmsh/detail/gmsh_picks.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::detail {

/// All sides of all elements, to be found by their nodes in any order.
template <class Element>
class ElementSides {
 public:
  using Side = std::array<int, Element::facet_nodes>;

  explicit ElementSides(Mesh<Element> const& mesh) {
    for (auto const& element : mesh.elements) {
      for (auto side : Element::facets()) {
        for (int& node : side) node = element[index(node)];
        sides_.push_back({sorted(side), side});
      }
    }
    std::sort(sides_.begin(), sides_.end(), [](auto const& a, auto const& b) { return a.key < b.key; });
  }

  /// Turns the nodes so that the outward normal of an element is theirs; between two elements the given sense stays.
  /// \return false when no element has such a side
  bool orient(Side& side) const {
    auto const key = sorted(side);
    auto const first = std::lower_bound(sides_.begin(), sides_.end(), key,
                                        [](Entry const& entry, Side const& wanted) { return entry.key < wanted; });
    if (first == sides_.end() || first->key != key) return false;
    for (auto entry = first; entry != sides_.end() && entry->key == key; ++entry) {
      if (same_winding<typename Element::Facet>(side, entry->nodes)) return true;
    }
    side = first->nodes;
    return true;
  }

 private:
  struct Entry {
    Side key;
    Side nodes;
  };

  static Side sorted(Side side) {
    std::sort(side.begin(), side.end());
    return side;
  }

  std::vector<Entry> sides_;
};

/// Physical groups of sides of another kind than the elements have.
template <class Element>
void refuse_other_sides(GmshContent const& content) {
  for (auto const& block : content.blocks) {
    bool const other_side = block.type.dim == Element::dim - 1 && block.type.type != Element::Facet::gmsh_type;
    if (!other_side || block.groups.empty() || block.tags.empty()) continue;
    refuse(
        "the physical group '{}' of '{}' holds elements of type {} ({}), such as {} (the sides of {} have type {}): "
        "give sides and elements the same order",
        gmsh_group_name(content, {block.type.dim, block.groups.front()}), content.file, block.type.type,
        block.type.name, block.tags.front(), find_gmsh_type(Element::gmsh_type)->element, Element::Facet::gmsh_type);
  }
}

template <class Element>
void read_gmsh_boundaries(GmshContent const& content, GmshNumbering const& numbering, Mesh<Element>& mesh) {
  constexpr int dim = Element::dim - 1;
  refuse_other_sides<Element>(content);
  for (auto const& [group, name] : content.names) {
    if (group.first == dim) mesh.boundaries[name];
  }
  auto picks = pick_gmsh_elements(content, Element::Facet::gmsh_type);
  std::erase_if(picks, [](GmshPick const& pick) { return pick.groups.empty(); });
  if (picks.empty()) return;
  ElementSides<Element> const sides(mesh);
  for (auto const& pick : picks) {
    auto side = numbering.template numbers<typename Element::Facet>(pick);
    if (!sides.orient(side)) {
      refuse("element {} of '{}' in the physical group '{}' lies on no side of an element: mesh the geometry again",
             pick.tag, content.file, gmsh_group_name(content, {dim, pick.groups.front()}));
    }
    for (int const group : pick.groups) mesh.boundaries[gmsh_group_name(content, {dim, group})].push_back(side);
  }
}

}  // namespace scarp::detail

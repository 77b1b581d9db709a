// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/element/reference_element.hpp"
#include "scarp/io/gmsh/detail/gmsh_forms.hpp"
#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/windings.hpp"

namespace scarp::detail {

using GmshPicks = std::vector<GmshElement const*>;

/// The elements of a type in the order of their tags: so all formats of a mesh give the same numbering.
inline GmshPicks pick_gmsh_elements(GmshContent const& content, int type) {
  GmshPicks picks;
  for (auto const& element : content.elements) {
    if (element.type->type == type) picks.push_back(&element);
  }
  std::ranges::stable_sort(picks, {}, [](auto const* pick) { return pick->tag; });
  return picks;
}

/// Numbers from 0 of those nodes of a file that elements use, in the order of their tags.
class GmshNumbering {
 public:
  GmshNumbering(GmshContent const& content, GmshPicks const& picks) : nodes_(content.nodes) {
    std::ranges::stable_sort(nodes_, {}, &GmshNode::tag);
    auto const twice = std::ranges::adjacent_find(nodes_, {}, &GmshNode::tag);
    if (twice != nodes_.end()) {
      reject("'{}' lists node {} twice (each node has its own tag): write the file again", content.file, twice->tag);
    }
    std::vector<bool> used(nodes_.size(), false);
    for (auto const* const pick : picks) {
      for (auto const tag : pick->nodes) {
        int const node = (*this)(tag);
        if (node < 0) {
          reject("element {} of '{}' names node {} (the file has no such node): write the file again", pick->tag,
                 content.file, tag);
        }
        used[index(node)] = true;
      }
    }
    std::size_t kept = 0;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (used[n]) nodes_[kept++] = nodes_[n];
    }
    nodes_.resize(kept);
  }

  std::vector<GmshNode> const& nodes() const { return nodes_; }

  /// \return -1 for a node that no element uses
  int operator()(std::int64_t tag) const {
    auto const found = std::ranges::lower_bound(nodes_, tag, {}, &GmshNode::tag);
    return found == nodes_.end() || found->tag != tag ? -1 : static_cast<int>(found - nodes_.begin());
  }

  /// The nodes of an element in the order of this library.
  template <class Cell>
  std::array<int, Cell::nodes> numbers(GmshElement const& element) const {
    std::array<int, Cell::nodes> numbers;
    for (int a = 0; a < Cell::nodes; ++a) numbers[index(a)] = (*this)(element.nodes[index(Cell::gmsh_order[index(a)])]);
    return element.turned ? turned_round<Cell>(numbers) : numbers;
  }

 private:
  std::vector<GmshNode> nodes_;
};

/// Turns the nodes of a side so that the outward normal of an element is theirs; between two elements the given sense
/// stays.
/// \return false when no element has such a side
template <class Element>
bool orient(std::array<int, Element::facet_nodes>& side, std::vector<MeshSide<Element>> const& sides) {
  auto const found = sides_with(sides, side);
  auto const has_sense = [&](auto const& other) { return same_winding<typename Element::Facet>(side, other.nodes); };
  if (!found.empty() && std::none_of(found.begin(), found.end(), has_sense)) side = found.front().nodes;
  return !found.empty();
}

/// Physical groups of sides of another kind than the elements have.
template <class Element>
void reject_other_sides(GmshContent const& content) {
  for (auto const& element : content.elements) {
    auto const& type = *element.type;
    bool const other_side = type.dim == Element::dim - 1 && type.type != Element::Facet::gmsh_type;
    if (!other_side || element.groups.empty()) continue;
    reject(
        "the physical group '{}' of '{}' holds elements of type {} ({}), such as {} (the sides of {} have type {}): "
        "give sides and elements the same order",
        gmsh_group_name(content, {type.dim, element.groups.front()}), content.file, type.type, type.name, element.tag,
        find_gmsh_type(Element::gmsh_type)->element, Element::Facet::gmsh_type);
  }
}

/// A side belongs to a boundary once, however often the file lists it: in several groups of one name, or as several
/// lines.
template <class Element>
void read_gmsh_boundaries(GmshContent const& content, GmshNumbering const& numbering, Mesh<Element>& mesh) {
  constexpr int dim = Element::dim - 1;
  reject_other_sides<Element>(content);
  for (auto const& [group, name] : content.names) {
    if (group.first == dim) mesh.boundaries[name];
  }
  auto picks = pick_gmsh_elements(content, Element::Facet::gmsh_type);
  std::erase_if(picks, [](auto const* pick) { return pick->groups.empty(); });
  if (picks.empty()) return;
  auto const sides = sorted_sides(mesh);
  std::set<std::pair<std::string, std::array<int, Element::facet_nodes>>> known;  // with sorted nodes
  for (auto const* const pick : picks) {
    auto side = numbering.template numbers<typename Element::Facet>(*pick);
    if (!orient(side, sides)) {
      reject("element {} of '{}' in the physical group '{}' lies on no side of an element: mesh the geometry again",
             pick->tag, content.file, gmsh_group_name(content, {dim, pick->groups.front()}));
    }
    for (int const group : pick->groups) {
      auto const name = gmsh_group_name(content, {dim, group});
      if (known.emplace(name, sorted_nodes(side)).second) mesh.boundaries[name].push_back(side);
    }
  }
}

}  // namespace scarp::detail

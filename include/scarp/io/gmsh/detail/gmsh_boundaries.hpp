// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/element/reference_element.hpp"
#include "scarp/io/gmsh/detail/gmsh_forms.hpp"
#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/windings.hpp"

namespace scarp::detail {

/// One element of a file.
struct GmshPick {
  std::int64_t tag;
  std::span<int const> groups;
  bool turned;
  std::int64_t const* nodes;  ///< tags, in Gmsh's order
};

/// The elements of a type in the order of their tags: so all formats of a mesh give the same numbering.
inline std::vector<GmshPick> pick_gmsh_elements(GmshContent const& content, int type) {
  std::vector<GmshPick> picks;
  for (auto const& block : content.blocks) {
    if (block.type.type != type) continue;
    auto const* nodes = block.nodes.data();
    for (auto const tag : block.tags) {
      picks.push_back({tag, block.groups, block.turned, nodes});
      nodes += block.type.nodes;
    }
  }
  std::ranges::stable_sort(picks, {}, &GmshPick::tag);
  return picks;
}

/// Numbers from 0 of those nodes of a file that elements use, in the order of their tags.
class GmshNumbering {
 public:
  GmshNumbering(GmshContent const& content, std::vector<GmshPick> const& picks, int nodes_each)
      : nodes_(content.nodes) {
    std::ranges::stable_sort(nodes_, {}, &GmshNode::tag);
    auto const twice = std::ranges::adjacent_find(nodes_, {}, &GmshNode::tag);
    if (twice != nodes_.end()) {
      reject("'{}' lists node {} twice (each node has its own tag): write the file again", content.file, twice->tag);
    }
    std::vector<bool> used(nodes_.size(), false);
    for (auto const& pick : picks) {
      for (auto const tag : std::span(pick.nodes, index(nodes_each))) {
        int const node = (*this)(tag);
        if (node < 0) {
          reject("element {} of '{}' names node {} (the file has no such node): write the file again", pick.tag,
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
  std::array<int, Cell::nodes> numbers(GmshPick const& pick) const {
    std::array<int, Cell::nodes> numbers;
    for (int a = 0; a < Cell::nodes; ++a) numbers[index(a)] = (*this)(pick.nodes[Cell::gmsh_order[index(a)]]);
    return pick.turned ? turned_round<Cell>(numbers) : numbers;
  }

 private:
  std::vector<GmshNode> nodes_;
};

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
    std::ranges::sort(sides_, {}, &Entry::key);
  }

  /// Turns the nodes so that the outward normal of an element is theirs; between two elements the given sense stays.
  /// \return false when no element has such a side
  bool orient(Side& side) const {
    auto const key = sorted(side);
    auto const first = std::ranges::lower_bound(sides_, key, {}, &Entry::key);
    bool const is_side = first != sides_.end() && first->key == key;
    for (auto entry = first; entry != sides_.end() && entry->key == key; ++entry) {
      if (same_winding<typename Element::Facet>(side, entry->nodes)) return true;
    }
    if (is_side) side = first->nodes;
    return is_side;
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
void reject_other_sides(GmshContent const& content) {
  for (auto const& block : content.blocks) {
    bool const other_side = block.type.dim == Element::dim - 1 && block.type.type != Element::Facet::gmsh_type;
    if (!other_side || block.groups.empty() || block.tags.empty()) continue;
    reject(
        "the physical group '{}' of '{}' holds elements of type {} ({}), such as {} (the sides of {} have type {}): "
        "give sides and elements the same order",
        gmsh_group_name(content, {block.type.dim, block.groups.front()}), content.file, block.type.type,
        block.type.name, block.tags.front(), find_gmsh_type(Element::gmsh_type)->element, Element::Facet::gmsh_type);
  }
}

/// A side belongs to a boundary once, however often the file lists it: in several groups of one name, or as several lines.
template <class Element>
void read_gmsh_boundaries(GmshContent const& content, GmshNumbering const& numbering, Mesh<Element>& mesh) {
  constexpr int dim = Element::dim - 1;
  reject_other_sides<Element>(content);
  for (auto const& [group, name] : content.names) {
    if (group.first == dim) mesh.boundaries[name];
  }
  auto picks = pick_gmsh_elements(content, Element::Facet::gmsh_type);
  std::erase_if(picks, [](GmshPick const& pick) { return pick.groups.empty(); });
  if (picks.empty()) return;
  ElementSides<Element> const sides(mesh);
  std::set<std::pair<std::string, std::array<int, Element::facet_nodes>>> known;  // with sorted nodes
  for (auto const& pick : picks) {
    auto side = numbering.template numbers<typename Element::Facet>(pick);
    if (!sides.orient(side)) {
      reject("element {} of '{}' in the physical group '{}' lies on no side of an element: mesh the geometry again",
             pick.tag, content.file, gmsh_group_name(content, {dim, pick.groups.front()}));
    }
    auto key = side;
    std::sort(key.begin(), key.end());
    for (int const group : pick.groups) {
      auto const name = gmsh_group_name(content, {dim, group});
      if (known.emplace(name, key).second) mesh.boundaries[name].push_back(side);
    }
  }
}

}  // namespace scarp::detail

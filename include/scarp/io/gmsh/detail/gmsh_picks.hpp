// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <span>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/io/gmsh/detail/gmsh_content.hpp"
#include "scarp/io/gmsh/detail/gmsh_winding.hpp"

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
  std::stable_sort(picks.begin(), picks.end(), [](auto const& a, auto const& b) { return a.tag < b.tag; });
  return picks;
}

/// Numbers from 0 of those nodes of a file that elements use, in the order of their tags.
class GmshNumbering {
 public:
  GmshNumbering(GmshContent const& content, std::vector<GmshPick> const& picks, int nodes_each)
      : file_(content.file), nodes_(content.nodes) {
    auto const by_tag = [](auto const& a, auto const& b) { return a.tag < b.tag; };
    std::stable_sort(nodes_.begin(), nodes_.end(), by_tag);
    auto const twice =
        std::adjacent_find(nodes_.begin(), nodes_.end(), [](auto const& a, auto const& b) { return a.tag == b.tag; });
    if (twice != nodes_.end()) {
      refuse("'{}' lists node {} twice (each node has its own tag): write the file again", file_, twice->tag);
    }
    std::vector<bool> used(nodes_.size(), false);
    for (auto const& pick : picks) {
      for (auto const tag : std::span(pick.nodes, index(nodes_each))) {
        auto const found = std::lower_bound(nodes_.begin(), nodes_.end(), GmshNode{tag, {}}, by_tag);
        if (found == nodes_.end() || found->tag != tag) {
          refuse("element {} of '{}' names node {} (the file has no such node): write the file again", pick.tag, file_,
                 tag);
        }
        used[detail::index(found - nodes_.begin())] = true;
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
    auto const found = std::lower_bound(nodes_.begin(), nodes_.end(), tag,
                                        [](GmshNode const& node, std::int64_t wanted) { return node.tag < wanted; });
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
  std::string file_;
  std::vector<GmshNode> nodes_;
};

/// The name of a physical group; files may leave it out.
inline std::string gmsh_group_name(GmshContent const& content, DimTag group) {
  auto const found = content.names.find(group);
  return found != content.names.end() ? found->second : fmt::format("physical_{}", group.second);
}

}  // namespace scarp::detail

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/io/gmsh/detail/gmsh_content.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp::detail {

/// Highest dimension of the elements of a file.
inline int gmsh_dimension(GmshContent const& content) {
  int dim = 0;
  for (auto const& block : content.blocks) dim = std::max(dim, block.tags.empty() ? 0 : block.type.dim);
  return dim;
}

/// The name of a physical group; files may leave it out.
inline std::string gmsh_group_name(GmshContent const& content, DimTag group) {
  auto const found = content.names.find(group);
  return found != content.names.end() ? found->second : fmt::format("physical_{}", group.second);
}

using GmshGroups = std::vector<int>;
using GmshNodes = std::span<std::int64_t const>;
using GmshPlace = std::tuple<int, GmshGroups, bool>;  ///< of an element: type, groups, whether it is turned

/// Puts each element into the block that `place_of(block, tag, nodes)` gives, into none for nothing.
template <class PlaceOf>
void rearrange_gmsh(GmshContent& content, PlaceOf const& place_of) {
  std::map<GmshPlace, GmshBlock> blocks;
  for (auto const& block : content.blocks) {
    auto const each = index(block.type.nodes);
    for (std::size_t e = 0; e < block.tags.size(); ++e) {
      auto const nodes = GmshNodes(block.nodes).subspan(e * each, each);
      std::optional<GmshPlace> const place = place_of(block, block.tags[e], nodes);
      if (!place) continue;
      GmshBlock empty{block.type, std::get<1>(*place), std::get<2>(*place)};
      auto& target = blocks.try_emplace(*place, std::move(empty)).first->second;
      target.tags.push_back(block.tags[e]);
      target.nodes.insert(target.nodes.end(), nodes.begin(), nodes.end());
    }
  }
  content.blocks.clear();
  for (auto& [place, block] : blocks) content.blocks.push_back(std::move(block));
}

/// Groups that stand as data of the elements, where the elements themselves are in none.
inline void take_gmsh_group_data(GmshContent& content) {
  auto const in_group = [](GmshBlock const& block) { return !block.groups.empty(); };
  if (content.group_data.empty() || std::any_of(content.blocks.begin(), content.blocks.end(), in_group)) return;
  rearrange_gmsh(content, [&](GmshBlock const& block, std::int64_t tag, GmshNodes) {
    GmshGroups groups;
    if (auto const found = content.group_data.find(tag); found != content.group_data.end())
      add_group(groups, found->second);
    return GmshPlace(block.type.type, groups, block.turned);
  });
  content.notes.push_back(fmt::format("'{}': the data 'gmsh:physical' are the physical groups", content.file));
}

/// The copies of an element become one, which is in the groups of all; what is in one group twice stays, to be rejected.
inline void join_gmsh_copies(GmshContent& content, int dim) {
  std::set<GmshGroups> used;
  for (auto const& block : content.blocks)
    if (block.type.dim == dim) used.insert(block.groups);
  if (!content.lists_copies || used.size() < 2) return;
  auto const sorted = [](GmshNodes nodes) {
    std::vector<std::int64_t> key(nodes.begin(), nodes.end());
    std::sort(key.begin(), key.end());
    return key;
  };
  std::map<std::vector<std::int64_t>, GmshGroups> groups_of;
  std::size_t elements = 0;
  rearrange_gmsh(content, [&](GmshBlock const& block, std::int64_t, GmshNodes nodes) {
    if (block.type.dim == dim) {
      ++elements;
      auto& groups = groups_of[sorted(nodes)];
      for (int const group : block.groups) add_group(groups, group);
    }
    return GmshPlace(block.type.type, block.groups, block.turned);
  });
  if (groups_of.size() == elements) return;
  rearrange_gmsh(content, [&](GmshBlock const& block, std::int64_t, GmshNodes nodes) -> std::optional<GmshPlace> {
    if (block.type.dim != dim) return GmshPlace(block.type.type, block.groups, block.turned);
    auto const& groups = groups_of[sorted(nodes)];
    bool const first = block.groups.empty() ? groups.empty() : block.groups.front() == groups.front();
    return first ? std::optional(GmshPlace(block.type.type, groups, block.turned)) : std::nullopt;
  });
}

/// Notes what a file names or holds that its mesh does not have.
inline void note_gmsh_rest(GmshContent& content, int dim) {
  auto const note = [&](std::string const& text) {
    content.notes.push_back(fmt::format("'{}': {}", content.file, text));
  };
  bool has_regions = false;
  std::size_t outside = 0;  // elements in no group
  std::set<std::pair<int, std::string>> names;
  for (auto const& block : content.blocks) {
    if (block.tags.empty()) continue;
    if (block.type.dim == dim && block.groups.empty()) outside += block.tags.size();
    for (int const group : block.groups)
      names.emplace(block.type.dim, gmsh_group_name(content, {block.type.dim, group}));
  }
  for (auto const& [group, name] : content.names) {
    has_regions = has_regions || group.first == dim;
    if (group.first < dim - 1) {
      note(fmt::format("the physical group '{}' of dimension {} is not read", name, group.first));
    } else if (names.insert({group.first, name}).second) {
      note(fmt::format("the physical group '{}' is empty: no element of dimension {} is in it", name, group.first));
    }
  }
  if (outside > 0 && has_regions)
    note(fmt::format("{} elements are in no physical group: they are the region 'mesh'", outside));
  for (auto const& section : content.skipped) {
    note(fmt::format("the section ${} is not read{}", section,
                     section == "Periodic" ? ": nothing ties the nodes of its sides" : ""));
  }
}

/// How many elements are in each group, and in each pair of groups, by name.
struct GmshGroupSizes {
  std::map<std::pair<std::string, std::string>, std::size_t> common{};

  GmshGroupSizes(GmshContent const& content, int dim) {
    for (auto const& block : content.blocks) {
      if (block.type.dim != dim) continue;
      std::set<std::string> names;
      for (int const group : block.groups) names.insert(gmsh_group_name(content, {dim, group}));
      for (auto const& a : names)
        for (auto const& b : names) common[{a, b}] += block.tags.size();
    }
  }

  std::size_t of(std::string const& a, std::string const& b) const { return common.at({a, b}); }
};

/// The smallest of an element's groups counts, as its material; the others are noted.
/// wanted: names of groups that count before others
/// \throws InputError where a group neither holds another one nor lies in it
inline void choose_gmsh_regions(GmshContent& content, int dim, std::vector<std::string> const& wanted) {
  GmshGroupSizes const sizes(content, dim);
  std::map<std::string, std::set<std::string>> parts_of;
  for (auto& block : content.blocks) {
    if (block.type.dim != dim || block.groups.size() < 2) continue;
    auto const name = [&](int group) { return gmsh_group_name(content, {dim, group}); };
    auto const is_wanted = [&](int group) {
      return std::find(wanted.begin(), wanted.end(), name(group)) != wanted.end();
    };
    int const part = std::ranges::min(block.groups, {}, [&](int group) {
      return std::tuple(!is_wanted(group), sizes.of(name(group), name(group)), group);
    });
    for (int const whole : block.groups) {
      auto const [a, b] = std::pair(name(part), name(whole));
      if (a == b) continue;
      if (is_wanted(part) == is_wanted(whole) && sizes.of(a, b) < sizes.of(a, a)) {
        reject(
            "element {} of '{}' is in the physical groups '{}' and '{}', and neither holds the other (an element has "
            "one "
            "material): write `Physical {}(\"{}\") -= {{...}};` in the .geo file, or read it with GmshOptions::regions",
            block.tags.front(), content.file, a, b, dim == 2 ? "Surface" : "Volume", b);
      }
      parts_of[b].insert(a);
    }
    block.groups = {part};
  }
  for (auto const& [whole, parts] : parts_of) {
    content.notes.push_back(fmt::format("'{}': elements of the physical group '{}' are in '{}' too, which count",
                                        content.file, whole, listed(parts, "', '")));
    bool const used = GmshGroupSizes(content, dim).common.count({whole, whole}) > 0;
    std::erase_if(content.names, [&, &whole = whole](auto const& group) {
      return !used && group.first.first == dim && group.second == whole;
    });
  }
}

/// The type of the same shape with fewer nodes, which are the first in Gmsh's order: corners, on sides, inside.
inline GmshType without_gmsh_nodes(GmshType const& type, int highest_order) {
  auto const shape = [](GmshType const& any) { return any.name.substr(any.name.rfind(' ') + 1); };
  if (highest_order == 1)
    return *std::ranges::find_if(gmsh_types, [&](GmshType const& other) { return shape(other) == shape(type); });
  return type.type == 10 ? *find_gmsh_type(16) : type.type == 12 ? *find_gmsh_type(17) : type;
}

inline void drop_gmsh_nodes(GmshContent& content, int highest_order) {
  std::set<std::string> noted;
  for (auto& block : content.blocks) {
    auto const type = without_gmsh_nodes(block.type, highest_order);
    if (type.type == block.type.type) continue;
    std::vector<std::int64_t> nodes;
    for (std::size_t e = 0; e < block.tags.size(); ++e)
      for (int a = 0; a < type.nodes; ++a) nodes.push_back(block.nodes[e * index(block.type.nodes) + index(a)]);
    if (!block.tags.empty() && noted.emplace(block.type.name).second) {
      content.notes.push_back(fmt::format("'{}': each {} is read as {}, without its other nodes", content.file,
                                          block.type.name, type.name));
    }
    block.type = type;
    block.nodes = std::move(nodes);
  }
}

/// Elements are turned that run clockwise in the plane or left-handed in space.
inline void turn_gmsh_elements(GmshContent& content, int dim) {
  std::map<std::int64_t, std::array<double, 3>> places;
  for (auto const& node : content.nodes) places.emplace(node.tag, node.position);
  std::size_t turned = 0;
  rearrange_gmsh(content, [&](GmshBlock const& block, std::int64_t, GmshNodes nodes) {
    double size = 0.0;  // twice the area, or six times the volume between the edges of the first corner
    auto const corners = block.type.dim == dim ? index(without_gmsh_nodes(block.type, 1).nodes) : 0;
    auto const place = [&](std::size_t corner) { return Eigen::Map<Vector<3> const>(places[nodes[corner]].data()); };
    auto const side = [&](std::size_t corner) -> Vector<3> { return place(corner) - place(0); };
    if (dim == 2) {
      for (std::size_t a = 2; a < corners; ++a) size += side(a - 1).cross(side(a)).z();
    } else if (corners > 0) {
      bool const on_triangle = corners == 4 || corners == 6;  // its first side: of tetrahedra and prisms
      size = side(1).cross(side(on_triangle ? 2 : 3)).dot(side(on_triangle ? 3 : 4));
    }
    bool const turn = size == 0.0 ? block.turned : size < 0.0;
    if (turn != (dim == 2 && block.turned)) ++turned;
    return GmshPlace(block.type.type, block.groups, turn);
  });
  if (turned > 0)
    content.notes.push_back(fmt::format("'{}': {} elements run {}: they are turned", content.file, turned,
                                        dim == 2 ? "clockwise" : "left-handed"));
}

/// Brings what a file may write in several ways into one form.
inline void normalise_gmsh(GmshContent& content, int highest_order, std::vector<std::string> const& regions) {
  int const dim = gmsh_dimension(content);
  take_gmsh_group_data(content);
  join_gmsh_copies(content, dim);
  note_gmsh_rest(content, dim);
  choose_gmsh_regions(content, dim, regions);
  drop_gmsh_nodes(content, highest_order);
  turn_gmsh_elements(content, dim);
}

}  // namespace scarp::detail

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
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
  for (auto const& element : content.elements) dim = std::max(dim, element.type->dim);
  return dim;
}

/// The name of a physical group; files may leave it out.
inline std::string gmsh_group_name(GmshContent const& content, DimTag group) {
  auto const found = content.names.find(group);
  return found != content.names.end() ? found->second : fmt::format("physical_{}", group.second);
}

using GmshGroups = std::vector<int>;

/// Groups that stand as data of the elements, where the elements themselves are in none.
inline void take_gmsh_group_data(GmshContent& content) {
  auto const in_group = [](GmshElement const& element) { return !element.groups.empty(); };
  if (content.group_data.empty() || std::ranges::any_of(content.elements, in_group)) return;
  for (auto& element : content.elements) {
    auto const found = content.group_data.find(element.tag);
    if (found != content.group_data.end()) add_group(element.groups, found->second);
  }
  content.notes.push_back(fmt::format("'{}': the data 'gmsh:physical' are the physical groups", content.file));
}

/// The copies of an element become one, which is in the groups of all; what is in one group twice stays, to be
/// rejected.
inline void join_gmsh_copies(GmshContent& content, int dim) {
  if (!content.lists_copies) return;
  auto const sorted = [](std::vector<std::int64_t> nodes) {
    std::ranges::sort(nodes);
    return nodes;
  };
  std::map<std::vector<std::int64_t>, GmshGroups> groups_of;
  for (auto const& element : content.elements) {
    if (element.type->dim != dim) continue;
    auto& groups = groups_of[sorted(element.nodes)];
    for (int const group : element.groups) add_group(groups, group);
  }
  std::vector<GmshElement> joined;
  for (auto& element : content.elements) {
    if (element.type->dim == dim) {
      auto const& groups = groups_of[sorted(element.nodes)];
      bool const first = element.groups.empty() ? groups.empty() : element.groups.front() == groups.front();
      if (!first) continue;
      element.groups = groups;
    }
    joined.push_back(std::move(element));
  }
  content.elements = std::move(joined);
}

/// Notes what a file names or holds that its mesh does not have.
inline void note_gmsh_rest(GmshContent& content, int dim) {
  auto const note = [&](std::string const& text) {
    content.notes.push_back(fmt::format("'{}': {}", content.file, text));
  };
  bool has_regions = false;
  std::size_t outside = 0;  // elements in no group
  std::set<DimTag> used;
  std::set<std::pair<int, std::string>> names;
  for (auto const& element : content.elements) {
    if (element.type->dim == dim && element.groups.empty()) ++outside;
    for (int const group : element.groups) used.emplace(element.type->dim, group);
  }
  for (auto const& group : used) names.emplace(group.first, gmsh_group_name(content, group));
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
inline std::map<std::pair<std::string, std::string>, std::size_t> gmsh_group_sizes(GmshContent const& content,
                                                                                   int dim) {
  std::map<GmshGroups, std::size_t> elements_in;
  for (auto const& element : content.elements)
    if (element.type->dim == dim) ++elements_in[element.groups];
  std::map<std::pair<std::string, std::string>, std::size_t> common;
  for (auto const& [groups, elements] : elements_in) {
    std::set<std::string> names;
    for (int const group : groups) names.insert(gmsh_group_name(content, {dim, group}));
    for (auto const& a : names)
      for (auto const& b : names) common[{a, b}] += elements;
  }
  return common;
}

/// The smallest of an element's groups counts, as its material; the others are noted.
/// wanted: names of groups that count before others
/// \throws InputError where a group neither holds another one nor lies in it
inline void choose_gmsh_regions(GmshContent& content, int dim, std::vector<std::string> const& wanted) {
  auto const sizes = gmsh_group_sizes(content, dim);
  std::map<std::string, std::set<std::string>> parts_of;
  for (auto& element : content.elements) {
    if (element.type->dim != dim || element.groups.size() < 2) continue;
    auto const name = [&](int group) { return gmsh_group_name(content, {dim, group}); };
    auto const is_wanted = [&](int group) {
      return std::find(wanted.begin(), wanted.end(), name(group)) != wanted.end();
    };
    int const part = std::ranges::min(element.groups, {}, [&](int group) {
      return std::tuple(!is_wanted(group), sizes.at({name(group), name(group)}), group);
    });
    for (int const whole : element.groups) {
      auto const [a, b] = std::pair(name(part), name(whole));
      if (a == b) continue;
      if (is_wanted(part) == is_wanted(whole) && sizes.at({a, b}) < sizes.at({a, a})) {
        reject(
            "element {} of '{}' is in the physical groups '{}' and '{}', and neither holds the other (an element has "
            "one "
            "material): write `Physical {}(\"{}\") -= {{...}};` in the .geo file, or read it with GmshOptions::regions",
            element.tag, content.file, a, b, dim == 2 ? "Surface" : "Volume", b);
      }
      parts_of[b].insert(a);
    }
    element.groups = {part};
  }
  for (auto const& [whole, parts] : parts_of) {
    content.notes.push_back(fmt::format("'{}': elements of the physical group '{}' are in '{}' too, which count",
                                        content.file, whole, listed(parts, "', '")));
    bool const used = gmsh_group_sizes(content, dim).contains({whole, whole});
    std::erase_if(content.names, [&, &whole = whole](auto const& group) {
      return !used && group.first.first == dim && group.second == whole;
    });
  }
}

/// The type of the same shape with fewer nodes, which are the first in Gmsh's order: corners, on sides, inside.
inline GmshType const& without_gmsh_nodes(GmshType const& type, int highest_order) {
  auto const shape = [](GmshType const& any) { return any.name.substr(any.name.rfind(' ') + 1); };
  if (highest_order == 1)
    return *std::ranges::find_if(gmsh_types, [&](GmshType const& other) { return shape(other) == shape(type); });
  return type.type == 10 ? *find_gmsh_type(16) : type.type == 12 ? *find_gmsh_type(17) : type;
}

inline void drop_gmsh_nodes(GmshContent& content, int highest_order) {
  std::set<GmshType const*> noted;
  for (auto& element : content.elements) {
    auto const& type = without_gmsh_nodes(*element.type, highest_order);
    if (&type == element.type) continue;
    if (noted.insert(element.type).second) {
      content.notes.push_back(fmt::format("'{}': each {} is read as {}, without its other nodes", content.file,
                                          element.type->name, type.name));
    }
    element.type = &type;
    element.nodes.resize(index(type.nodes));
  }
}

/// Elements are turned that run clockwise in the plane or left-handed in space.
inline void turn_gmsh_elements(GmshContent& content, int dim) {
  std::map<std::int64_t, std::array<double, 3>> places;
  for (auto const& node : content.nodes) places.emplace(node.tag, node.position);
  std::size_t turned = 0;
  for (auto& element : content.elements) {
    if (element.type->dim != dim) continue;
    double size = 0.0;  // twice the area, or six times the volume between the edges of the first corner
    auto const corners = index(without_gmsh_nodes(*element.type, 1).nodes);
    auto const place = [&](std::size_t corner) {
      return Eigen::Map<Vector<3> const>(places[element.nodes[corner]].data());
    };
    auto const side = [&](std::size_t corner) -> Vector<3> { return place(corner) - place(0); };
    if (dim == 2) {
      for (std::size_t a = 2; a < corners; ++a) size += side(a - 1).cross(side(a)).z();
    } else if (dim == 3) {
      bool const on_triangle = corners == 4 || corners == 6;  // its first side: of tetrahedra and prisms
      size = side(1).cross(side(on_triangle ? 2 : 3)).dot(side(on_triangle ? 3 : 4));
    }
    bool const turn = size == 0.0 ? element.turned : size < 0.0;
    if (turn != (dim == 2 && element.turned)) ++turned;
    element.turned = turn;
  }
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

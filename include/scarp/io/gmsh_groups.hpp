// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scarp/io/gmsh_sink.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::detail {

/// What a file says of one physical group: elements of a region or sides of a boundary.
struct GmshGroup {
  std::string name;
  std::int32_t dim;
  std::int32_t tag;
};

/// Elements in the order of a file, one after the other of one type and group.
struct GmshRun {
  GmshGroup group;
  std::int32_t type;
  std::int32_t nodes_each;
  std::int32_t first_tag;
  std::vector<std::int32_t> nodes{};  ///< tags, in Gmsh's order

  std::size_t size() const { return nodes.size() / index(nodes_each); }

  template <class Cell>
  void add(std::array<int, Cell::nodes> const& numbers) {
    std::array<std::int32_t, Cell::nodes> ordered{};
    for (int a = 0; a < Cell::nodes; ++a) ordered[index(Cell::gmsh_order[index(a)])] = numbers[index(a)] + 1;
    nodes.insert(nodes.end(), ordered.begin(), ordered.end());
  }
};

inline std::string const& require_gmsh_name(std::string const& name) {
  constexpr std::size_t longest = 127;  // [GmshManual], section "MSH file format"
  if (name.empty() || name.size() > longest || name.find_first_of("\"\r\n") != std::string::npos) {
    refuse("a region or boundary is named '{}' (Gmsh takes 1 to {} letters on one line, no quotes): rename it", name,
           longest);
  }
  return name;
}

/// Regions first, then boundaries, numbered from 1.
template <class Element>
std::vector<GmshGroup> gmsh_groups(Mesh<Element> const& mesh) {
  std::vector<GmshGroup> groups;
  auto const next = [&] { return static_cast<std::int32_t>(groups.size() + 1); };
  for (auto const& name : mesh.regions) {
    for (auto const& other : groups) {
      if (other.name == name) refuse("two regions are named '{}' (a file cannot tell them apart): rename one", name);
    }
    groups.push_back({require_gmsh_name(name), Element::dim, next()});
  }
  for (auto const& entry : mesh.boundaries) {
    groups.push_back({require_gmsh_name(entry.first), Element::dim - 1, next()});
  }
  return groups;
}

/// Elements in their order, numbered from 1, then the sides of the boundaries.
template <class Element>
std::vector<GmshRun> gmsh_runs(Mesh<Element> const& mesh, std::vector<GmshGroup> const& groups) {
  using Facet = typename Element::Facet;
  std::vector<GmshRun> runs;
  std::int32_t next = 1;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    auto const& group = groups[index(mesh.element_region[e])];
    if (runs.empty() || runs.back().group.tag != group.tag) {
      runs.push_back({group, Element::gmsh_type, Element::nodes, next});
    }
    runs.back().template add<Element>(mesh.elements[e]);
    ++next;
  }
  auto group = groups.begin() + count(mesh.regions);
  for (auto const& entry : mesh.boundaries) {
    runs.push_back({*group++, Facet::gmsh_type, Facet::nodes, next});
    for (auto const& side : entry.second) runs.back().template add<Facet>(side);
    next += count(entry.second);
  }
  return runs;
}

}  // namespace scarp::detail

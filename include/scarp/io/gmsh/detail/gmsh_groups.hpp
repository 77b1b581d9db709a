// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scarp/io/gmsh/detail/gmsh_sink.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::detail {

/// What a file says of one physical group: elements of a region or sides of a boundary.
struct GmshGroup {
  std::string name;
  std::int32_t dim;
  std::int32_t tag;
};

/// The elements of one group, all of one type.
struct GmshRun {
  GmshGroup group;
  std::int32_t type;
  std::int32_t nodes_each;
  std::vector<std::int32_t> tags{};
  std::vector<std::int32_t> nodes{};  ///< tags, in Gmsh's order

  std::size_t size() const { return tags.size(); }

  template <class Cell>
  void add(std::int32_t tag, std::array<int, Cell::nodes> const& numbers) {
    std::array<std::int32_t, Cell::nodes> ordered{};
    for (int a = 0; a < Cell::nodes; ++a) ordered[index(Cell::gmsh_order[index(a)])] = numbers[index(a)] + 1;
    tags.push_back(tag);
    nodes.insert(nodes.end(), ordered.begin(), ordered.end());
  }
};

inline std::string const& require_gmsh_name(std::string const& name) {
  constexpr std::size_t longest = 127;  // Gmsh 4.8 Reference Manual, section 9.1
  if (name.empty() || name.size() > longest || name.find_first_of("\"\r\n") != std::string::npos) {
    refuse("a region or boundary is named '{}' (Gmsh takes 1 to {} letters on one line, no quotes): rename it", name,
           longest);
  }
  return name;
}

/// Regions first, then boundaries, with tags from 1.
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

/// One run for each group that is not empty. The tags are the elements' order, from 1, then that of the sides.
template <class Element>
std::vector<GmshRun> gmsh_runs(Mesh<Element> const& mesh) {
  using Facet = typename Element::Facet;
  std::vector<GmshRun> runs;
  for (auto const& group : gmsh_groups(mesh)) {
    bool const region = group.dim == Element::dim;
    runs.push_back({group, region ? Element::gmsh_type : Facet::gmsh_type, region ? Element::nodes : Facet::nodes});
  }
  std::int32_t tag = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    runs[index(mesh.element_region[e])].template add<Element>(++tag, mesh.elements[e]);
  }
  auto run = runs.begin() + count(mesh.regions);
  for (auto const& entry : mesh.boundaries) {
    for (auto const& side : entry.second) run->template add<Facet>(++tag, side);
    ++run;
  }
  std::erase_if(runs, [](GmshRun const& empty) { return empty.size() == 0; });
  return runs;
}

}  // namespace scarp::detail

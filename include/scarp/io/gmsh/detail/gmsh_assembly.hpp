// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/error.hpp"
#include "scarp/io/gmsh/detail/gmsh_boundaries.hpp"

namespace scarp::detail {

/// Positions [m] of the numbered nodes; a plane mesh must lie in one plane of constant z.
template <class Element>
void read_gmsh_positions(GmshContent const& content, GmshNumbering const& numbering, Mesh<Element>& mesh) {
  constexpr double flat = 1e-9;  // of the mesh's size: round-off of a geometry kernel
  double extent = 0.0;
  auto const& nodes = numbering.nodes();
  for (auto const& node : nodes) {
    Vector<Element::dim> position;
    for (int k = 0; k < Element::dim; ++k) {
      position(k) = node.position[index(k)];
      extent = std::max(extent, std::abs(position(k) - nodes.front().position[index(k)]));
    }
    mesh.nodes.push_back(position);
  }
  if constexpr (Element::dim == 2) {
    for (auto const& node : nodes) {
      if (std::abs(node.position[2] - nodes.front().position[2]) > flat * extent) {
        refuse("node {} of '{}' is at z = {}, node {} at z = {} (a plane mesh has one z): turn it into the xy plane",
               node.tag, content.file, node.position[2], nodes.front().tag, nodes.front().position[2]);
      }
    }
  }
}

/// The only physical group of an element, zero for none.
inline int gmsh_region(GmshContent const& content, GmshPick const& pick, int dim) {
  if (pick.groups.size() > 1) {
    refuse("element {} of '{}' is in the physical groups '{}' and '{}' (it can have one material): keep one of them",
           pick.tag, content.file, gmsh_group_name(content, {dim, pick.groups[0]}),
           gmsh_group_name(content, {dim, pick.groups[1]}));
  }
  return pick.groups.empty() ? 0 : pick.groups.front();
}

/// Names the regions in the order of their tags; elements without group form the region "mesh".
template <class Element>
void read_gmsh_regions(GmshContent const& content, std::vector<GmshPick> const& picks, Mesh<Element>& mesh) {
  constexpr int dim = Element::dim;
  std::map<int, int> number;  // of the region, by tag
  for (auto const& [group, name] : content.names) {
    if (group.first == dim) number[group.second] = -1;
  }
  for (auto const& pick : picks) number[gmsh_region(content, pick, dim)] = -1;
  for (auto& [tag, region] : number) {
    auto const name = tag == 0 ? std::string("mesh") : gmsh_group_name(content, {dim, tag});
    auto const known = std::find(mesh.regions.begin(), mesh.regions.end(), name);
    region = static_cast<int>(known - mesh.regions.begin());
    if (known == mesh.regions.end()) mesh.regions.push_back(name);
  }
  for (auto const& pick : picks) mesh.element_region.push_back(number[gmsh_region(content, pick, dim)]);
}

template <class Element>
void refuse_repeated_elements(GmshContent const& content, std::vector<GmshPick> const& picks,
                              Mesh<Element> const& mesh) {
  using Entry = std::pair<std::array<int, Element::nodes>, std::int64_t>;
  std::vector<Entry> entries;
  for (std::size_t e = 0; e < picks.size(); ++e) {
    entries.emplace_back(mesh.elements[e], picks[e].tag);
    auto& nodes = entries.back().first;
    std::sort(nodes.begin(), nodes.end());
    if (std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end()) {
      refuse("element {} of '{}' names a node twice (it has collapsed): mesh the geometry again", picks[e].tag,
             content.file);
    }
  }
  std::sort(entries.begin(), entries.end());
  auto const twice = std::adjacent_find(entries.begin(), entries.end(),
                                        [](Entry const& a, Entry const& b) { return a.first == b.first; });
  if (twice != entries.end()) {
    refuse(
        "elements {} and {} of '{}' have the same nodes (MSH 2.2 repeats what is in two physical groups): give each "
        "element one group of its dimension",
        twice->second, std::next(twice)->second, content.file);
  }
}

/// Names the elements as the file does, which the check of the mesh cannot.
template <class Element>
void refuse_inverted_elements(GmshContent const& content, std::vector<GmshPick> const& picks,
                              Mesh<Element> const& mesh) {
  constexpr std::string_view advice = Element::dim == 2
                                          ? "turn the surface so that its normal points along z, or mesh it again"
                                          : "mesh the geometry again";
  for (int e = 0; e < count(mesh.elements); ++e) {
    if (auto const determinant = bad_jacobian(mesh, e)) {
      auto const& pick = picks[index(e)];
      refuse(
          "element {} of '{}' (its nodes there: {}) has the Jacobian {} m^{} (flat, or its nodes run the wrong way "
          "round): {}",
          pick.tag, content.file, listed(std::span(pick.nodes, index(Element::nodes))), *determinant, Element::dim,
          advice);
    }
  }
}

template <class Element>
Mesh<Element> assemble_gmsh(GmshContent const& content) {
  require_gmsh_kind(content, Element::gmsh_type);
  auto const picks = pick_gmsh_elements(content, Element::gmsh_type);
  GmshNumbering const numbering(content, picks, Element::nodes);
  Mesh<Element> mesh;
  read_gmsh_positions(content, numbering, mesh);
  for (auto const& pick : picks) mesh.elements.push_back(numbering.template numbers<Element>(pick));
  read_gmsh_regions(content, picks, mesh);
  refuse_repeated_elements(content, picks, mesh);
  refuse_inverted_elements(content, picks, mesh);
  read_gmsh_boundaries(content, numbering, mesh);
  return mesh;
}

}  // namespace scarp::detail

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>

#include "scarp/core/error.hpp"
#include "scarp/fault/detail/ground_outline.hpp"
#include "scarp/fault/detail/step_at_tip.hpp"
#include "scarp/fault/ground.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "scarp/mesh/mesh_checks.hpp"

namespace scarp {

namespace detail {

template <class Element>
void require_ground_groups(Mesh<Element> const& mesh) {
  std::vector<std::string> used;
  for (int r = 0; r < count(mesh.regions); ++r) {
    auto const& numbers = mesh.element_region;
    if (std::find(numbers.begin(), numbers.end(), r) != numbers.end()) used.push_back(mesh.regions[index(r)]);
  }
  bool const has_soil = std::find(used.begin(), used.end(), "soil") != used.end();
  bool const others =
      std::any_of(used.begin(), used.end(), [](auto const& r) { return r != "soil" && r != "footing"; });
  if (!has_soil || others) {
    reject(
        "the mesh has elements in the regions {} (a ground has 'soil' and, where a block stands on it, 'footing'; "
        "elements "
        "in no physical group are the region 'mesh'): name the physical groups so",
        listed(used));
  }
  std::vector<std::string> wanted;
  for (auto const& part : outline_parts(mesh)) wanted.push_back(part.name);
  if (std::find(used.begin(), used.end(), "footing") != used.end()) {
    for (auto const* const name : {"footing_base", "footing_top"}) wanted.emplace_back(name);
  }
  std::vector<std::string> there;
  for (auto const& [name, facets] : mesh.boundaries) {
    if (!facets.empty()) there.push_back(name);
  }
  for (auto const& name : wanted) {
    if (std::find(there.begin(), there.end(), name) != there.end()) continue;
    reject("the mesh has no side in a boundary '{}' (it has: {}): put the sides there in a physical group of this name",
           name, there.empty() ? "none" : listed(there));
  }
}

/// Names what a file leaves without any group: elements "soil", sides at the ends of the soil by their place.
/// \return a sentence for each of the two
template <class Element>
std::vector<std::string> name_by_place(Mesh<Element>& mesh) {
  std::vector<std::string> notes;
  auto const in_no_group = [&](int region) { return mesh.regions[index(region)] == "mesh"; };
  if (std::ranges::all_of(mesh.element_region, in_no_group)) {
    mesh.regions = {"soil"};
    std::ranges::fill(mesh.element_region, 0);
    notes.emplace_back("no element is in a physical group: all are 'soil'");
  }
  auto const is_empty = [](auto const& boundary) { return boundary.second.empty(); };
  bool const has_soil = std::find(mesh.regions.begin(), mesh.regions.end(), "soil") != mesh.regions.end();
  if (!has_soil || !std::ranges::all_of(mesh.boundaries, is_empty)) return notes;
  mesh.boundaries.clear();
  SoilEnds<Element> const ends(mesh);
  for (auto const& part : outline_parts(mesh)) {
    for (auto const& side : outer_facets(mesh)) {
      auto const at_end = [&](int node) { return ends.has(part, mesh.nodes[index(node)]); };
      bool const of_soil = mesh.regions[index(mesh.element_region[index(side.element)])] == "soil";
      if (of_soil && std::ranges::all_of(side.nodes, at_end)) mesh.boundaries[part.name].push_back(side.nodes);
    }
  }
  notes.emplace_back("no side is in a physical group: those at the ends of the soil are named by their place");
  return notes;
}

/// \throws InputError naming the fault and its place
template <class Element>
void require_ground(Mesh<Element> const& mesh) {
  require_ground_groups(mesh);
  require_no_duplicate_nodes(mesh);
  require_no_hanging_nodes(mesh);
  require_straight_outline(mesh);
  require_closed_outline(mesh);
}

}  // namespace detail

/// Ground on a mesh from elsewhere: region "soil", level "surface" and "bottom" across the last axis, upright "left"
/// and "right", in space "front" and "back" across the second; where a footing stands "footing_base", and with the
/// region "footing" its "footing_top". `ground_from_file` checks all of this.
template <CheckedElement E>
struct MeshFileGround {
  using Element = E;  ///< of the mesh

  Mesh<Element> given;  ///< as it was read or made elsewhere

  /// edges: x [m] where a structure needs corner nodes on the surface
  /// \throws InputError for an edge without one, naming the nearest
  Mesh<Element> mesh(std::vector<double> const& edges) const {
    if (edges.empty()) return given;
    auto corners = detail::corners_along(given, "surface");
    if (given.boundaries.count("footing_base") != 0) {
      auto const below = detail::corners_along(given, "footing_base");
      corners.insert(corners.end(), below.begin(), below.end());
      std::sort(corners.begin(), corners.end());
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    }
    double const same = 1e-7 * (corners.back() - corners.front());  // what files with seven digits hold
    for (double const edge : edges) detail::require_corner(corners, edge, same);
    return given;
  }

  /// Along the last axis [m].
  double surface_level() const { return scarp::surface_level(given); }
};

/// Reads a ground from a file of Gmsh. A file of the straight element serves for the quadratic one: nodes are put in
/// the middle of its sides. In a file without groups elements are soil and sides are named by their place.
/// \throws InputError naming the file for what read_gmsh rejects, missing or further regions, missing boundaries, nodes
/// at one place, hanging nodes, boundaries that are not straight at the soil's ends, and sides of the soil in no
/// boundary or in two
/// notes: gets what the ground has in another way than the file, see GmshFile
/// highest_order: of the elements, see GmshOptions
template <HasGmshType E>
MeshFileGround<E> ground_from_file(std::filesystem::path const& path, std::vector<std::string>* notes = nullptr,
                                   int highest_order = 2) {
  GmshFile const file(path, {.highest_order = highest_order, .regions = {"soil", "footing"}});
  auto const read = [&]() -> Mesh<E> {
    if constexpr (HasMidSides<E>) {
      if (file.element_type() == E::Linear::gmsh_type) {
        return with_nodes_of<E>(file.mesh<typename E::Linear>());
      }
    }
    return file.mesh<E>();
  };
  MeshFileGround<E> ground{read()};
  auto const named = detail::name_by_place(ground.given);
  if (notes != nullptr) {
    *notes = file.notes();
    for (auto const& note : named) notes->push_back(fmt::format("'{}': {}", path.string(), note));
  }
  with_context(fmt::format("'{}'", path.string()), [&] { detail::require_ground(ground.given); });
  double const depth = ground.surface_level() - bottom_level(ground.given);
  constexpr double least = 0.1, most = 1000.0;  // [m]
  if (notes != nullptr && !(depth >= least && depth <= most))
    notes->push_back(fmt::format("'{}': the ground is {:.4g} m deep (from {} m to {} m are usual): lengths are metres",
                                 path.string(), depth, least, most));
  return ground;
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scarp/io/gmsh/detail/gmsh_boundaries.hpp"
#include "scarp/io/gmsh/detail/gmsh_content.hpp"
#include "scarp/io/gmsh/detail/gmsh_sections.hpp"
#include "scarp/io/read_file.hpp"

namespace scarp::detail {

/// How many elements of a dimension a file has, by type.
inline std::map<int, std::size_t> gmsh_kinds(GmshContent const& content, int dim) {
  std::map<int, std::size_t> kinds;
  for (auto const& element : content.elements) {
    if (element.type->dim == dim) ++kinds[element.type->type];
  }
  return kinds;
}

/// Such as "12 x type 2 (3-node triangle), 40 x type 3 (4-node quadrangle)".
inline std::string shown_gmsh_kinds(std::map<int, std::size_t> const& kinds) {
  std::vector<std::string> parts;
  for (auto const& [type, elements] : kinds) {
    parts.push_back(fmt::format("{} x type {} ({})", elements, type, find_gmsh_type(type)->name));
  }
  return listed(parts);
}

/// What to do about elements that are not of the type that is wanted.
inline std::string other_kind_advice(std::map<int, std::size_t> const& kinds) {
  if (kinds.size() > 1) {
    return "mesh with one kind of element: `gmsh FILE.geo -2 -setnumber Mesh.SubdivisionAlgorithm 1` gives quadrangles "
           "only, a .geo file without Recombine triangles only";
  }
  GmshType const& type = *find_gmsh_type(kinds.begin()->first);
  auto const straight = without_gmsh_nodes(type, 1).element;
  if (type.element.empty())
    return straight.empty() ? "mesh with another kind of element"
                            : fmt::format("give highest_order = 1 and read it as {}", straight);
  return fmt::format("read it as {}{}", type.element,
                     straight == type.element ? "" : fmt::format(", or with highest_order = 1 as {}", straight));
}

/// \throws InputError unless all elements of the file's highest dimension are of this type
inline void require_gmsh_kind(GmshContent const& content, int wanted) {
  GmshType const& type = *find_gmsh_type(wanted);
  int const highest = gmsh_dimension(content);
  auto const kinds = gmsh_kinds(content, highest);
  if (highest < 2) {
    reject(
        "'{}' holds neither surface nor volume elements (once there is a physical group, Gmsh saves only what is in "
        "one): mesh in {}D and put surfaces or volumes into groups",
        content.file, type.dim);
  }
  if (highest != type.dim) {
    reject("'{}' is a {}D mesh with {} ({} needs a {}D one): {}", content.file, highest, shown_gmsh_kinds(kinds),
           type.element, type.dim, other_kind_advice(kinds));
  }
  if (kinds.size() > 1 || kinds.begin()->first != wanted) {
    reject("'{}' holds {} (all elements of a mesh of {} are of type {}): {}", content.file, shown_gmsh_kinds(kinds),
           type.element, wanted, other_kind_advice(kinds));
  }
}

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
        reject("node {} of '{}' is at z = {}, node {} at z = {} (a plane mesh has one z): turn it into the xy plane",
               node.tag, content.file, node.position[2], nodes.front().tag, nodes.front().position[2]);
      }
    }
  }
}

/// Names the regions in the order of their tags; elements without group form the region "mesh".
template <class Element>
void read_gmsh_regions(GmshContent const& content, GmshPicks const& picks, Mesh<Element>& mesh) {
  constexpr int dim = Element::dim;
  std::map<int, int> number;  // of the region, by tag
  for (auto const& [group, name] : content.names) {
    if (group.first == dim) number[group.second] = -1;
  }
  auto const group_of = [](auto const* pick) { return pick->groups.empty() ? 0 : pick->groups.front(); };
  for (auto const* const pick : picks) number[group_of(pick)] = -1;
  for (auto& [tag, region] : number) {
    auto const name = tag == 0 ? std::string("mesh") : gmsh_group_name(content, {dim, tag});
    auto const known = std::find(mesh.regions.begin(), mesh.regions.end(), name);
    region = static_cast<int>(known - mesh.regions.begin());
    if (known == mesh.regions.end()) mesh.regions.push_back(name);
  }
  for (auto const* const pick : picks) mesh.element_region.push_back(number[group_of(pick)]);
}

template <class Element>
void reject_repeated_elements(GmshContent const& content, GmshPicks const& picks, Mesh<Element> const& mesh) {
  using Entry = std::pair<std::array<int, Element::nodes>, std::int64_t>;
  std::vector<Entry> entries;
  for (std::size_t e = 0; e < picks.size(); ++e) {
    auto const& nodes = entries.emplace_back(sorted_nodes(mesh.elements[e]), picks[e]->tag).first;
    if (std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end()) {
      reject("element {} of '{}' names a node twice (it has collapsed): mesh the geometry again", picks[e]->tag,
             content.file);
    }
  }
  std::sort(entries.begin(), entries.end());
  auto const twice = std::ranges::adjacent_find(entries, {}, &Entry::first);
  if (twice != entries.end()) {
    reject("elements {} and {} of '{}' have the same nodes (each place has one element): leave one out", twice->second,
           std::next(twice)->second, content.file);
  }
}

/// Names the elements as the file does, which the check of the mesh cannot.
template <class Element>
void reject_wrong_elements(GmshContent const& content, GmshPicks const& picks, Mesh<Element> const& mesh) {
  for (int e = 0; e < count(mesh.elements); ++e) {
    if (auto const determinant = bad_jacobian(mesh, e)) {
      auto const& pick = *picks[index(e)];
      reject(
          "element {} of '{}' (its nodes there: {}) has the Jacobian {} m^{} (flat, or its nodes run the wrong way "
          "round): mesh the geometry again",
          pick.tag, content.file, listed(pick.nodes), *determinant, Element::dim);
    }
  }
  if (auto const both = overlapping_elements(sorted_sides(mesh)))
    reject("elements {} and {} of '{}' lie on the same side of a facet (they overlap): mesh the geometry again",
           picks[index(both->first)]->tag, picks[index(both->second)]->tag, content.file);
}

template <class Element>
Mesh<Element> assemble_gmsh(GmshContent const& content) {
  require_gmsh_kind(content, Element::gmsh_type);
  auto const picks = pick_gmsh_elements(content, Element::gmsh_type);
  GmshNumbering const numbering(content, picks);
  Mesh<Element> mesh;
  read_gmsh_positions(content, numbering, mesh);
  for (auto const* const pick : picks) mesh.elements.push_back(numbering.template numbers<Element>(*pick));
  read_gmsh_regions(content, picks, mesh);
  reject_repeated_elements(content, picks, mesh);
  reject_wrong_elements(content, picks, mesh);
  read_gmsh_boundaries(content, numbering, mesh);
  return mesh;
}

}  // namespace scarp::detail

namespace scarp {

/// What of a file of Gmsh counts.
struct GmshOptions {
  int highest_order = 2;  ///< of elements, 1 or 2; at 1 all nodes but corners are left out: sides become straight
  std::vector<std::string> regions{};  ///< physical groups that count before others where an element lies in several
};

/// A file of Gmsh, read once: MSH 2 to 2.2, 4.0 or 4.1, text or binary, of any order of bytes.
class GmshFile {
 public:
  /// \throws InputError naming file and line or byte for what is no mesh of Gmsh or is damaged, and for an order but 1
  /// and 2
  explicit GmshFile(std::filesystem::path const& path, GmshOptions const& options = {})
      : GmshFile(read_file(path), path.string(), options) {}
  /// bytes: of the file; name: in messages
  GmshFile(std::string bytes, std::string const& name, GmshOptions const& options = {})
      : content_(detail::read_gmsh_content(std::move(bytes), name)) {
    require_between("highest order of a Gmsh file's elements", options.highest_order, 1, 2);
    detail::normalise_gmsh(content_, options.highest_order, options.regions);
  }

  /// Gmsh's number of the type of the elements, to choose the one that mesh() reads them as (`Tri6::gmsh_type`); of
  /// several types in the highest dimension the lowest number, 0 without surfaces and volumes.
  int element_type() const {
    int const highest = detail::gmsh_dimension(content_);
    return highest < 2 ? 0 : detail::gmsh_kinds(content_, highest).begin()->first;
  }

  /// What mesh() has in another way than the file, or not: turned elements, dropped nodes, empty physical groups,
  /// groups that hold others, sections that are not read. A sentence each.
  std::vector<std::string> notes() const { return content_.notes; }

  /// Physical groups of the elements' dimension become regions, those of one dimension less boundaries, with each side
  /// once; without a name they are called "physical_<tag>". Elements in no group form the region "mesh", those in
  /// several the smallest of them. Nodes and elements are numbered in the order of their tags; nodes of no element,
  /// points and elements of lower dimension in no group are left out. Lengths in [m].
  /// \throws InputError naming file and node or element for what is no mesh of such elements, is flat or turned inside
  /// out, or in 2D not flat in z
  template <HasGmshType Element>
  Mesh<Element> mesh() const {
    return detail::assemble_gmsh<Element>(content_);
  }

 private:
  detail::GmshContent content_;
};

/// The mesh of a file of Gmsh, see GmshFile. \throws InputError
template <HasGmshType Element>
Mesh<Element> read_gmsh(std::filesystem::path const& path, GmshOptions const& options = {}) {
  return GmshFile(path, options).mesh<Element>();
}

}  // namespace scarp

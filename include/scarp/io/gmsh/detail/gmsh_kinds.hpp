// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/io/gmsh/detail/gmsh_content.hpp"

namespace scarp::detail {

/// How many elements of a dimension a file has, by type.
inline std::map<int, std::size_t> gmsh_kinds(GmshContent const& content, int dim) {
  std::map<int, std::size_t> kinds;
  for (auto const& block : content.blocks) {
    if (block.type.dim == dim && !block.tags.empty()) kinds[block.type.type] += block.tags.size();
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
  if (kinds.size() > 1) return "mesh with one kind of element (in Gmsh recombine all surfaces or none)";
  auto const element = find_gmsh_type(kinds.begin()->first)->element;
  if (element.empty()) return "mesh with another kind (in Gmsh order 1 or 2, with Mesh.SecondOrderIncomplete = 1)";
  return fmt::format("read it as {}", element);
}

/// \throws InputError unless all elements of the file's highest dimension are of this type
inline void require_gmsh_kind(GmshContent const& content, int wanted) {
  GmshType const& type = *find_gmsh_type(wanted);
  int highest = 0;
  for (auto const& block : content.blocks) {
    if (!block.tags.empty()) highest = std::max(highest, block.type.dim);
  }
  auto const kinds = gmsh_kinds(content, highest);
  if (highest < 2) {
    refuse(
        "'{}' holds neither surface nor volume elements (once there is a physical group, Gmsh saves only what is in "
        "one): mesh in {}D and put surfaces or volumes into groups",
        content.file, type.dim);
  }
  if (highest != type.dim) {
    refuse("'{}' is a {}D mesh with {} ({} needs a {}D one): {}", content.file, highest, shown_gmsh_kinds(kinds),
           type.element, type.dim, other_kind_advice(kinds));
  }
  if (kinds.size() > 1 || kinds.begin()->first != wanted) {
    refuse("'{}' holds {} (all elements of a mesh of {} are of type {}): {}", content.file, shown_gmsh_kinds(kinds),
           type.element, wanted, other_kind_advice(kinds));
  }
}

}  // namespace scarp::detail

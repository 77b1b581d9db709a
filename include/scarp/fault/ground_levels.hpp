// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/mesh/mesh.hpp"

namespace scarp {

namespace detail {

template <class Element>
double level_of(Mesh<Element> const& mesh, std::string_view name) {
  auto const& facets = boundary(mesh, name);
  if (facets.empty()) refuse("the boundary '{}' is empty (it has no level): mesh the ground with it", name);
  return mesh.nodes[index(facets.front().front())](Element::dim - 1);
}

}  // namespace detail

/// Height of a ground's level bottom along the last axis [m].
/// \throws InputError for a mesh without "bottom"
template <ReferenceElement Element>
double bottom_level(Mesh<Element> const& mesh) {
  return detail::level_of(mesh, "bottom");
}

/// Height of its level surface along the last axis [m].
/// \throws InputError for a mesh without "surface"
template <ReferenceElement Element>
double surface_level(Mesh<Element> const& mesh) {
  return detail::level_of(mesh, "surface");
}

}  // namespace scarp

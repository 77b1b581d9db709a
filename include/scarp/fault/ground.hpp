// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <vector>

#include "scarp/bvp/default_grid.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

namespace detail {

template <class Element>
double level_of(Mesh<Element> const& mesh, std::string_view name) {
  return mesh.nodes[index(boundary(mesh, name).front().front())](Element::dim - 1);
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

/// Ground on a grid made for it, of any element.
template <CheckedElement E = Tri3>
struct StructuredGround {
  using Element = E;  ///< of the mesh

  FaultMesh layer{};  ///< layer that the mesh is made of

  /// edges: x [m] where a structure needs corner nodes on the surface
  Mesh<Element> mesh(std::vector<double> const& edges) const { return layer.generate<Element>(edges); }

  double surface_level() const { return layer.depth; }  ///< along the last axis [m]
};

/// The ground of a scene: a mesh with the region "soil" and the boundaries "left", "right", "bottom" and "surface",
/// and the height of its level surface [m]. edges: where along x [m] a structure wants nodes on the surface; a ground
/// whose mesh is given need not follow; the structure reports nodes that it misses.
template <class G>
concept Ground = requires(G const& ground, std::vector<double> const& edges) {
  requires ReferenceElement<typename G::Element>;
  { ground.mesh(edges) } -> std::same_as<Mesh<typename G::Element>>;
  { ground.surface_level() } -> std::same_as<double>;
};

/// The default grid of a ground.
template <class G>
using DefaultGridOf = DefaultGrid<typename G::Element>;

}  // namespace scarp

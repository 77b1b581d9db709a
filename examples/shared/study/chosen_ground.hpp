// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>

#include "choice.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/fault/given_ground.hpp"
#include "scarp/fault/layered_ground.hpp"
#include "scarp/fault/normal_fault.hpp"

namespace fault_rupture {

/// The element is compiled in: a program for another one is another target, see examples/fault_rupture/CMakeLists.txt.
#ifndef FAULT_RUPTURE_ELEMENT
#define FAULT_RUPTURE_ELEMENT Tri3
#endif
using Element = scarp::FAULT_RUPTURE_ELEMENT;
inline constexpr char const* element_name = Element::nodes == 3   ? "tri3"
                                            : Element::nodes == 6 ? "tri6"
                                            : Element::nodes == 4 ? "quad4"
                                                                  : "quad8";
inline constexpr bool is_triangle = Element::nodes % 3 == 0;

/// A layer in a mesh of its own, or the mesh of a file.
template <class ElementType>
struct ChosenGround {
  using Element = ElementType;

  scarp::FaultMesh layer{};
  std::optional<scarp::GivenGround<Element>> given{};

  scarp::Mesh<Element> mesh(std::vector<double> const& edges) const {
    return given ? given->mesh(edges) : layer.generate<Element>(edges);
  }
  double surface_level() const { return given ? given->surface_level() : layer.depth; }
  double depth() const { return given ? given->surface_level() - scarp::bottom_level(given->given) : layer.depth; }
};

/// \throws scarp::InputError for choices that do not fit together
template <class ElementType>
ChosenGround<ElementType> ground_of(Choice const& choice) {
  if (!choice.mesh.empty()) {
    if (choice.pattern || choice.aspect != 1.0 || choice.triangles > 0) {
      scarp::refuse(
          "--mesh '{}' is given with --pattern, --aspect or --triangles (a file has its own mesh): leave these out",
          choice.mesh);
    }
    return {.given = scarp::ground_from_file<ElementType>(choice.mesh)};
  }
  auto const pattern = choice.pattern.value_or(is_triangle ? MeshPattern::crossed : MeshPattern::quads);
  scarp::FaultMesh layer{.tip = choice.tip, .size = choice.size, .row_aspect = choice.aspect};
  switch (pattern) {
    case MeshPattern::left: layer.pattern = scarp::Pattern::left; break;
    case MeshPattern::right: layer.pattern = scarp::Pattern::right; break;
    case MeshPattern::quads: layer.pattern = scarp::Pattern::quads; break;
    case MeshPattern::crossed: layer.pattern = scarp::Pattern::crossed; break;
    case MeshPattern::jittered:
      layer.pattern = is_triangle ? scarp::Pattern::crossed : scarp::Pattern::quads;
      layer.jitter = 0.25;
      layer.seed = choice.mesh_seed;
      break;
  }
  if (choice.triangles > 0) layer = layer.with_about<ElementType>(choice.triangles);
  return {.layer = layer};
}

/// A normal fault, or the same backwards.
struct ChosenFault : scarp::NormalFault {
  bool reverse = false;

  scarp::Vector<2> right() const { return (reverse ? -1.0 : 1.0) * NormalFault::right(); }
};

}  // namespace fault_rupture

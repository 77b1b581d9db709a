// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>

#include "scarp/core/listed.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// A degree of freedom in words: node, place, axis and the regions that the node belongs to.
template <class Element>
std::string describe_dof(Mesh<Element> const& mesh, int dof) {
  constexpr int dim = Element::dim;
  int const node = dof / dim;
  if (dof < 0) return "an unknown degree of freedom";
  if (node >= detail::count(mesh.nodes))
    return fmt::format("degree of freedom {} beside the mesh", dof - dim * detail::count(mesh.nodes));
  std::set<std::string> regions;
  for (int e = 0; e < detail::count(mesh.elements); ++e) {
    auto const& nodes = mesh.elements[detail::index(e)];
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end())
      regions.insert(mesh.regions[detail::index(mesh.element_region[detail::index(e)])]);
  }
  return fmt::format("node {} at ({}), axis {}, region {}", node,
                     listed(mesh.nodes[detail::index(node)], ", ", "{:.6g}"), dof % dim, listed(regions, " and "));
}

}  // namespace scarp

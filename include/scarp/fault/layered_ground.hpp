// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/fault/fault_mesh.hpp"

namespace scarp {

/// Ground on a grid made for it, of any element.
template <CheckedElement E = Tri3>
struct LayeredGround {
  using Element = E;

  FaultMesh layer{};

  /// edges: x [m] where a structure needs corner nodes on the surface
  Mesh<Element> mesh(std::vector<double> const& edges) const { return layer.generate<Element>(edges); }

  double surface_level() const { return layer.depth; }  ///< along the last axis [m]
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/fault/fault_scene.hpp"

namespace scarp {

/// Nothing stands on the ground.
struct NoStructure {
  static std::vector<double> edges() { return {}; }  ///< No lines of the mesh are needed.
  /// The place of a footing that a mesh marks is bare surface here.
  template <class Element>
  static void put_on(Mesh<Element>& mesh) {
    auto const base = mesh.boundaries.extract("footing_base");
    if (base.empty()) return;
    auto& surface = mesh.boundaries["surface"];
    surface.insert(surface.end(), base.mapped().begin(), base.mapped().end());
  }
  /// Load factor before the fault moves; no stage places a structure.
  static constexpr double start() { return 0.0; }
  template <class Grid>
  static void add_loads(Grid const&, double, LoadHistory&) {}  ///< Adds no loads.
  /// Nothing is attached to the mesh.
  template <class Grid>
  static NoAttachment attached(Grid const&) {
    return {};
  }
  /// Materials of the mesh: the soil.
  template <class Soil>
  static auto regions(Region<Soil> const& soil) {
    return boost::hana::make_tuple(soil);
  }
};

/// Nothing but ground and fault; by default the reference study's case.
template <CheckedMaterial Soil, class Solver = QuasiNewton<>, Ground GroundType = StructuredGround<Tri3>,
          BedrockMotion Motion = NormalFault, class Grid = DefaultGridOf<GroundType>>
using FreeFieldFault = FaultScene<Soil, NoStructure, Solver, GroundType, Motion, Grid>;

}  // namespace scarp

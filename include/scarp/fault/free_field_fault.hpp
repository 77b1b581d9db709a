// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/fault/fault_scene.hpp"

namespace scarp {

/// Nothing stands on the ground.
struct BareGround {
  static FaultMesh on(FaultMesh const& layer) { return layer; }
  static constexpr int extra_dofs() { return 0; }
  static constexpr double start() { return 0.0; }
  template <class Grid>
  static void add_loads(Grid const&, double, LoadHistory&) {}
  template <class Grid>
  static NoAttachment attached(Grid const&) {
    return {};
  }
  template <class Soil>
  static auto regions(Region<Soil> const& soil) {
    return boost::hana::make_tuple(soil);
  }
};

/// The study's free-field case.
template <ConstitutiveProvider Soil, class Solver = QuasiNewton<>>
using FreeFieldFault = FaultScene<Soil, BareGround, Solver>;

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#ifdef SCARP_PRECOMPILED
#include "scarp/bvp/loads.hpp"
#include "scarp/bvp/usual_integration.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/fault/dip_slip_faults.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/scene/scene.hpp"
#include "scarp/solver/thread_executor.hpp"

/// What `scarp::precompiled` has of level ground over a normal fault: meshes and loads of the usual elements, and elastic
/// ground of triangles as a whole. DECLARE: `extern template`, or `template` in the library.
#define SCARP_GROUND(DECLARE, ELEMENT)                                                                         \
  DECLARE Mesh<ELEMENT> FaultMesh::generate<ELEMENT>(std::vector<double> const&) const;                        \
  DECLARE void require_node_at_tip(Mesh<ELEMENT> const&, double);                                              \
  DECLARE Constraints bedrock_constraints(Mesh<ELEMENT> const&, NormalFault const&, int, TimeFunction const&); \
  DECLARE Eigen::VectorXd body_force(UsualGrid<ELEMENT> const&, std::vector<Vector<2>> const&);                \
  DECLARE Eigen::VectorXd traction(UsualGrid<ELEMENT> const&, std::string_view, Vector<2> const&);             \
  DECLARE detail::RegionResiduals<2>::RegionResiduals(Mesh<ELEMENT> const&, Constraints const&);
#define SCARP_ELASTIC_GROUND(DECLARE)                                                 \
  DECLARE class ProviderField<detail::ElasticGround>;                                 \
  DECLARE class RegionMaterials<detail::ElasticGround>;                               \
  DECLARE class PointAnswers<RegionMaterials<detail::ElasticGround>, ThreadExecutor>; \
  DECLARE class EquilibriumProblem<UsualGrid<Tri3>, RegionMaterials<detail::ElasticGround>, ThreadExecutor>;

namespace scarp {

namespace detail {
using ElasticGround = LinearElastic<2, GeostaticStress<2>>;
}

SCARP_GROUND(extern template, Tri3)
SCARP_GROUND(extern template, Tri6)
SCARP_GROUND(extern template, Quad4)
SCARP_GROUND(extern template, Quad8)
SCARP_ELASTIC_GROUND(extern template)

}  // namespace scarp
#endif

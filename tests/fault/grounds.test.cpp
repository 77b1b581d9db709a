// SPDX-License-Identifier: BSL-1.0
// The fault scene on every element and pattern of a layer.
#include <doctest/doctest.h>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/fault/dip_slip_faults.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "support/elements.hpp"

namespace {

using Newton = scarp::QuasiNewton<>;

template <int dim>
using Soil = scarp::LinearElastic<dim, scarp::GeostaticStress<dim>>;

template <class Ground, class Motion = scarp::NormalFault, class Grid = scarp::DefaultGrid<typename Ground::Element>>
using Scene = scarp::FreeFieldFault<Soil<Ground::Element::dim>, Newton, Ground, Motion, Grid>;

template <class SceneType>
SceneType elastic(SceneType scene) {
  scene.soil = std::remove_cvref_t<decltype(scene.soil)>::from_young_poisson(20e6, 0.3,
                                                                             {scene.surcharge, scene.unit_weight, 0.4});
  scene.throw_to = 0.25;
  scene.solver.tolerance = 1e-9;
  return scene;
}

/// Settlement of the surface at some places [m], after the rupture.
template <class SceneType>
Eigen::VectorXd ruptured(SceneType const& scene, std::vector<double> const& places) {
  scarp::ThreadExecutor executor(1);
  scarp::NoObserver no_observer;
  auto problem = scene.problem(executor);
  REQUIRE(scene.settle(problem, no_observer).verdict.acceptable());
  REQUIRE(scene.rupture(problem, no_observer).verdict.acceptable());
  auto const& grid = problem.discretisation();
  constexpr int up = SceneType::dim - 1;
  std::vector<std::pair<double, double>> profile;
  for (int const node : boundary_nodes(grid.mesh(), "surface")) {
    auto const k = static_cast<std::size_t>(node);
    profile.emplace_back(grid.mesh().nodes[k](0), grid.mesh().nodes[k](up) - grid.positions()[k](up));
  }
  std::sort(profile.begin(), profile.end());
  Eigen::VectorXd found(static_cast<Eigen::Index>(places.size()));
  for (std::size_t p = 0; p < places.size(); ++p) {
    auto const after = std::lower_bound(profile.begin(), profile.end(), std::pair(places[p], -1e300));
    auto const before = after == profile.begin() ? after : std::prev(after);
    double const width = after->first - before->first;
    double const share = width > 0.0 ? (places[p] - before->first) / width : 0.0;
    found(static_cast<Eigen::Index>(p)) = before->second + share * (after->second - before->second);
  }
  return found;
}

template <class Element, class Grid = scarp::DefaultGrid<Element>>
Eigen::VectorXd on_layer(scarp::FaultMesh const& layer) {
  Scene<scarp::StructuredGround<Element>, scarp::NormalFault, Grid> scene;
  scene.ground.layer = layer;
  return ruptured(elastic(scene), {-30.0, -15.0, -5.0, 5.0, 15.0});
}

/// On elements small enough that the others are measured by it; made once.
Eigen::VectorXd const& exact() {
  static Eigen::VectorXd const made = on_layer<scarp::Quad8>({.size = 2.0});
  return made;
}

/// A hexahedron between two planes that do not move along the strike, and the quadrilateral whose shapes it then has,
/// with the same points.
struct FullyIntegrated {
  using Plane = scarp::Discretisation<scarp::Quad4, scarp::UpdatedLagrangian, scarp::FullIntegration>;
  using Space = scarp::Discretisation<scarp::Hex8, scarp::UpdatedLagrangian, scarp::FullIntegration>;
};
struct Reduced {
  using Plane = scarp::DefaultGrid<scarp::Quad8>;
  using Space = scarp::DefaultGrid<scarp::Hex20>;
};

scarp::FaultMesh coarse() { return {.size = 5.0}; }

}  // namespace

TEST_CASE_TEMPLATE("all elements tell the same surface, in space as slabs of one element", Element, scarp::Tri3,
                   scarp::Quad8 ALSO_NIGHTLY(scarp::Quad4, scarp::Tri6, scarp::Hex8, scarp::Tet4, scarp::Tet10)) {
  // Of the throw; linear elements of 5 m in ground of 25 m have five rows.
  double const most = scarp::HasMidSides<Element> ? 0.01 : std::is_same_v<Element, scarp::Tet4> ? 0.05 : 0.03;
  CHECK((on_layer<Element>(coarse()) - exact()).template lpNorm<Eigen::Infinity>() < most * 0.25);
}

TEST_CASE("all patterns, aspects and jittered meshes tell the same surface") {
  for (auto const pattern : {scarp::Pattern::crossed, scarp::Pattern::left, scarp::Pattern::right}) {
    for (double const aspect : {0.6, 1.73}) {
      for (double const jitter : {0.0, 0.25}) {
        scarp::FaultMesh const layer{.size = 2.5, .row_aspect = aspect, .pattern = pattern, .jitter = jitter};
        CHECK((on_layer<scarp::Tri3>(layer) - exact()).lpNorm<Eigen::Infinity>() < 0.03 * 0.25);
      }
    }
  }
}

TEST_CASE_TEMPLATE("a slab of one hexahedron is its quadrilateral", Pair, FullyIntegrated ALSO_NIGHTLY(Reduced)) {
  // Analytic. Round-off of some tens of increments.
  auto const plane = on_layer<typename Pair::Plane::ElementType, typename Pair::Plane>(coarse());
  auto const space = on_layer<typename Pair::Space::ElementType, typename Pair::Space>(coarse());
  CHECK((plane - space).norm() < 1e-8);
}

TEST_CASE("small reverse and normal faults in elastic ground are each other's mirror") {
  Scene<scarp::StructuredGround<scarp::Tri3>> normal;
  Scene<scarp::StructuredGround<scarp::Tri3>, scarp::ReverseFault> reverse;
  normal.ground.layer = reverse.ground.layer = coarse();
  normal = elastic(normal);
  reverse = elastic(reverse);
  normal.throw_to = reverse.throw_to = 0.01;
  std::vector<double> const places{-15.0, -5.0, 5.0};
  auto const down = ruptured(normal, places);
  auto const up = ruptured(reverse, places);
  // Second order in the throw over the depth, 4e-4.
  CHECK((down + up).norm() < 2e-3 * down.norm());
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/scene/scene.hpp"

#include <doctest/doctest.h>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "support/approx.hpp"

namespace {

namespace hana = boost::hana;
using Grid = scarp::Discretisation<scarp::Tri3>;
using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
using Concrete = scarp::LinearElastic<2>;
using TwoRegions = scarp::RegionMaterials<Soil, Concrete>;
static_assert(scarp::MaterialField<TwoRegions>);

constexpr double depth = 25.0;

Grid ground_with_footing() {
  auto mesh = scarp::FaultMesh{.depth = depth, .size = 8.0}.generate({-15.0, -5.0});
  scarp::mark_footing_base(mesh, -10.0, 10.0);
  scarp::add_footing_block(mesh, 2.0, 8.0);
  return Grid(mesh);
}

scarp::Region<Soil> soil() { return {"soil", Soil::from_young_poisson(20e6, 0.3, {.unit_weight = 16e3, .k0 = 0.5})}; }
scarp::Region<Concrete> footing() { return {"footing", Concrete::from_young_poisson(20e9, 0.2)}; }

}  // namespace

TEST_CASE("every point answers with the provider of its own region") {
  auto const grid = ground_with_footing();
  TwoRegions materials(grid, depth, hana::make_tuple(soil(), footing()));
  REQUIRE(materials.point_count() == grid.point_count());
  scarp::Gradient<2> stretch = scarp::Gradient<2>::Zero();
  stretch(0, 0) = 1e-6;
  int in_footing = 0;
  for (int point = 0; point < grid.point_count(); ++point) {
    auto const site = grid.site(point, depth);
    bool const above = site.depth < 0.0;
    in_footing += above ? 1 : 0;
    // Analytic: -gamma z in the ground, nothing in the footing.
    double const vertical = above ? 0.0 : -16e3 * site.depth;
    CHECK(materials.committed_stress(point)(1) == samples::Approx(vertical).epsilon(1e-14));
    double const shear_modulus = above ? 20e9 / 2.4 : 20e6 / 2.6;  // analytic: E / (2 (1 + nu))
    CHECK(materials.committed_tangent(point)(2, 2) == samples::Approx(shear_modulus).epsilon(1e-14));
    auto const before = materials.committed_stress(point);
    auto const answer = materials.respond(point, stretch);
    CHECK(materials.committed_stress(point) == before);
    double const modulus = materials.committed_tangent(point)(0, 0);
    // Round-off of the initial stress, and E - ln U of second order.
    CHECK(answer.stress(0) - before(0) == samples::Approx(modulus * 1e-6).epsilon(1e-5));
    CHECK(materials.work(point) == 0);
  }
  CHECK(in_footing > 0);
  CHECK(in_footing < grid.point_count());
  auto const before = materials.committed_stress(0);
  materials.commit();
  CHECK(materials.committed_stress(0) != before);
}

TEST_CASE("the order in which regions are named does not matter") {
  auto const grid = ground_with_footing();
  TwoRegions const materials(grid, depth, hana::make_tuple(soil(), footing()));
  scarp::RegionMaterials<Concrete, Soil> const other(grid, depth, hana::make_tuple(footing(), soil()));
  for (int point = 0; point < grid.point_count(); ++point) {
    CHECK(materials.committed_stress(point) == other.committed_stress(point));
    CHECK(materials.committed_tangent(point) == other.committed_tangent(point));
  }
}

TEST_CASE("materials sit at the points of any integration") {
  using Reduced = scarp::Discretisation<scarp::Quad8, scarp::SmallStrain, scarp::ReducedIntegration>;
  Reduced const grid(scarp::BoxMesh<scarp::Quad8>{.cells = {3, 2}}.generate());
  scarp::RegionMaterials<Soil> const materials(grid, 1.0, hana::make_tuple(soil()));
  CHECK(materials.point_count() == 4 * 3 * 2);
  // Analytic: -gamma z at the points' own depths.
  for (int point = 0; point < grid.point_count(); ++point) {
    double const depth_of_point = grid.site(point, 1.0).depth;
    CHECK(materials.committed_stress(point)(1) == samples::Approx(-16e3 * depth_of_point).epsilon(1e-14));
  }
}

TEST_CASE("visiting a point shows its provider's own state") {
  auto const grid = ground_with_footing();
  TwoRegions const materials(grid, depth, hana::make_tuple(soil(), footing()));
  int visits = 0;
  for (int point = 0; point < grid.point_count(); ++point) {
    materials.visit(point, [&](auto const& field, int local) {
      ++visits;
      CHECK(field.provider().stress(field.committed(local)) == materials.committed_stress(point));
    });
  }
  CHECK(visits == grid.point_count());
}

TEST_CASE("regions that do not fit the mesh are refused by name") {
  auto const grid = ground_with_footing();
  auto raft = footing();
  raft.name = "raft";
  using OnlySoil = scarp::RegionMaterials<Soil>;
  CHECK_THROWS_WITH_AS(OnlySoil(grid, depth, hana::make_tuple(soil())),
                       doctest::Contains("region 'footing' of the mesh has no provider"), scarp::InputError);
  CHECK_THROWS_WITH_AS(TwoRegions(grid, depth, hana::make_tuple(soil(), raft)),
                       doctest::Contains("there is no region 'raft' (the mesh has: soil, footing)"), scarp::InputError);
  using Twice = scarp::RegionMaterials<Soil, Concrete, Soil>;
  CHECK_THROWS_WITH_AS(Twice(grid, depth, hana::make_tuple(soil(), footing(), soil())),
                       doctest::Contains("region 'soil' is given two providers"), scarp::InputError);
}

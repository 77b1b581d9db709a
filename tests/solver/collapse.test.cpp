// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/collapse.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using Grid = scarp::Discretisation<scarp::Quad8, scarp::SmallStrain, scarp::ReducedIntegration>;
using Soil = scarp::MohrCoulomb<2>;

scarp::IsotropicElasticity stiffness() { return scarp::IsotropicElasticity::from_young_poisson(100e6, 0.3); }

/// A slope of 2 to 1 on a rough base, 10 m high, as in Griffiths and Lane (1999), example 1: phi = 20 degrees, c = 0.05 gamma H, no dilation.
scarp::Model<2> slope(double factor) {
  double const height = 10.0, crest = 12.0, weight = 20e3;
  scarp::Model<2> model(Grid(scarp::BoxMesh<scarp::Quad8>{
      .lengths = scarp::Vector<2>(1.0, height), .cells = {16, 8}, .map = [=](scarp::Vector<2> const& box) {
        return scarp::Vector<2>(box.x() * (crest + 2.0 * (height - box.y())), box.y());
      }}.generate()));
  model.fix({"left"}, 0);
  model.fix({"bottom"});
  model.gravity(weight);
  double const friction = std::atan(std::tan(20.0 / 180.0 * 3.14159265358979) / factor);
  model.material("soil", Soil{.elasticity = stiffness(),
                              .strength = {{.cohesion = 0.05 * weight * height / factor, .friction = friction}}});
  return model;
}

}  // namespace

TEST_CASE("a slope's factor of safety is that of its reference") {
  auto const found = scarp::reduce_strength(slope, 1.0, 2.0, {.tolerance = 0.02});
  INFO(found.why);
  REQUIRE(found.is_found());
  CHECK(found.stands < 1.43);  // 1.4 by finite elements, 1.38 by Bishop and Morgenstern's charts
  CHECK(found.fails > 1.36);
}

TEST_CASE("a block of clay between smooth platens carries 2 c, and less is carried in words") {
  scarp::Model<2> model(
      Grid(scarp::BoxMesh<scarp::Quad8>{.lengths = scarp::Vector<2>(2.0, 2.0), .cells = {2, 2}}.generate()));
  model.fix({"left"}, 0);
  model.fix({"bottom"}, 1);
  model.surcharge({"top"}, 1e3, scarp::TimeFunction::after(1.0));
  model.material("soil", Soil{.elasticity = stiffness(), .strength = {{.cohesion = 10e3}}});
  scarp::CollapseSettings settings;
  settings.analysis.stepping = {.first = 1.0, .smallest = 1e-3, .largest = 2.0};
  scarp::Analysis analysis(model, settings.analysis);
  REQUIRE(analysis.to(1.0).verdict.acceptable());
  auto const carried = find_collapse(analysis, 11.0, settings);
  CHECK(carried.stands());
  CHECK(!carried.failed);
  CHECK(carried.ratio == samples::Approx(1.0).epsilon(1e-4));  // logarithms of strains of 1e-4
  auto const end = find_collapse(analysis, 41.0, settings);
  INFO(end.why, end.ratio);
  CHECK(end.failed);
  CHECK(end.why.starts_with("the ground fails beyond the load factor 2"));
  CHECK(1e3 * (end.load - 1.0) == samples::Approx(20e3).epsilon(1e-3));  // analytic
}

TEST_CASE("settings that make no sense are rejected") {
  CHECK_REFUSED(scarp::reduce_strength(slope, 0.0, 2.0), "least factor of safety");
  CHECK_REFUSED(scarp::reduce_strength(slope, 2.0, 1.0), "largest factor of safety");
  CHECK_REFUSED(scarp::detail::validated(scarp::CollapseSettings{.failed = 5.0}), "has failed");
}

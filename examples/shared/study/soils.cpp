// SPDX-License-Identifier: BSL-1.0
#include "soils.hpp"

#include <numbers>
#include <vector>

#include "any_soil.hpp"
#include "scarp/fault/level_ground.hpp"
#include "scarp/io/packings/packing_tables.hpp"
#include "study_sand.hpp"

namespace fault_rupture {

namespace {

/// Level ground at the study's K0 of about 0.4.
scarp::GeostaticStress<2> ground_at_rest() { return {.surcharge = surcharge, .unit_weight = unit_weight, .k0 = 0.4}; }

/// What all soils' scenes share.
template <class Soil>
AnySoil solved(Choice const& choice, Soil const& soil, typename Soil::Solver solver) {
  double const tolerance = choice.tolerance.value_or(Soil::tolerance(choice));
  solver.tolerance = tolerance;
  solver.most_iterations = choice.most_iterations;
  return {.provider = soil,
          .solver = {solver},
          .tolerance = tolerance,
          .largest_gradient = choice.largest_gradient.value_or(Soil::largest_gradient(choice.quick)),
          .loose_pressure = 0.25 * surcharge};
}

scarp::IsotropicElasticity soil_elasticity() { return scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25); }

}  // namespace

Sand make_sand(Choice const& choice, std::vector<double> depths) {
  auto const law = examples::study_law();
  scarp::LevelGround<scarp::EllipseGrading> ground;
  ground.cloud = examples::study_cloud(choice.grains, choice.seed);
  ground.unit_weight = unit_weight;
  ground.surcharge = surcharge;
  ground.preparation.preparation_friction = choice.preparation_friction;
  Sand sand;
  auto& packings = sand.provider;
  packings.law = law;
  packings.source = ground.make<Grains>(law, std::move(depths));
  packings.strain_per_step = choice.strain_per_step;
  packings.least_steps = choice.least_dem_steps;
  packings.unbalanced_tolerance = choice.unbalanced_tolerance;
  packings.loose_pressure = surcharge / 2.0;
  return sand;
}

FrictionalSoil make_frictional_soil() {
  constexpr double degree = std::numbers::pi / 180.0;
  scarp::Strength const peak{.cohesion = 1e3, .friction = 30.8 * degree, .dilation = 6.6 * degree};
  scarp::Strength const residual{.cohesion = 1e3, .friction = (30.8 - 0.8 * 6.6) * degree, .dilation = 0.0};
  return {{soil_elasticity(), {.peak = peak, .residual = residual, .strain_to_residual = 0.15}, ground_at_rest()}};
}

ElasticSoil make_elastic_soil() { return {{soil_elasticity(), ground_at_rest()}}; }

AnySoil any_soil(Choice const& choice, std::vector<double> depths) {
  switch (choice.soil) {
    case Soil::dem: {
      auto const sand = make_sand(choice, std::move(depths));
      auto soil = solved(choice, sand, {});
      soil.loose_pressure = sand.provider.loose_pressure;
      auto const& packings = sand.provider.source.packings;
      soil.write_packing = [packing = packings[packings.size() / 2],
                            law = sand.provider.law](std::filesystem::path const& folder) {
        scarp::write_packing_tables(folder, packing, law);
      };
      return soil;
    }
    case Soil::mohr_coulomb: {
      FrictionalSoil::Solver solver;
      solver.rule.floor = FrictionalSoil::tangent_floor;
      return solved(choice, make_frictional_soil(), solver);
    }
    case Soil::elastic: break;
  }
  return solved(choice, make_elastic_soil(), {});
}

}  // namespace fault_rupture

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <numbers>
#include <vector>

#include "../study_sand.hpp"
#include "choice.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/softening_strength.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/scene/level_ground.hpp"
#include "scarp/solver/consistent_tangent.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace fault_rupture {

inline constexpr double unit_weight = 15.68e3;  ///< [N/m3]
inline constexpr double surcharge = 4e3;        ///< [Pa]

using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;

/// The study's ellipses, consolidated under the overburden of every depth; the solver learns tangents from answers.
struct Sand : scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>> {
  using Solver = scarp::QuasiNewton<>;
  static double tolerance(bool quick) { return quick ? 1e-2 : 5e-3; }
  static double largest_gradient(bool quick) { return quick ? 0.02 : 0.01; }
};

/// Mohr-Coulomb with the study's angles at the peak, 30.8 and 6.6 degrees, and Bolton's angle at constant volume, phi - 0.8 psi
/// (Geotechnique 36, 1986), after 15 % of plastic shear; cohesion of 1 kPa; stiffness near that of the packings.
struct FrictionalSoil : scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength> {
  using Solver = scarp::QuasiNewton<scarp::ConsistentTangent>;
  static double tolerance(bool) { return 1e-10; }
  static double largest_gradient(bool) { return 0.02; }
};

struct ElasticSoil : scarp::LinearElastic<2, scarp::GeostaticStress<2>> {
  using Solver = scarp::QuasiNewton<scarp::ConsistentTangent>;
  static double tolerance(bool) { return 1e-10; }
  static double largest_gradient(bool) { return 0.02; }
};

/// Level ground at the study's K0 of about 0.4.
inline scarp::GeostaticStress<2> ground_at_rest() {
  return {.surcharge = surcharge, .unit_weight = unit_weight, .k0 = 0.4};
}

inline scarp::IsotropicElasticity soil_elasticity() {
  return scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25);
}

/// Depths of all points of the soil [m].
inline std::vector<double> depths(scarp::FaultMesh const& layer) {
  scarp::Discretisation<scarp::Tri3> const grid(layer.generate());
  int const soil = scarp::region_number(grid.mesh(), "soil");
  std::vector<double> found;
  for (int point = 0; point < grid.point_count(); ++point) {
    auto const site = grid.site(point, layer.depth);
    if (site.region == soil) found.push_back(site.depth);
  }
  return found;
}

/// layer: the mesh that the scene will have
/// \throws scarp::PreparationError
inline Sand make_sand(Choice const& choice, scarp::FaultMesh const& layer) {
  auto const law = examples::study_law();
  scarp::LevelGround<scarp::EllipseGrading> ground;
  ground.cloud = examples::study_cloud(choice.grains, choice.seed);
  ground.unit_weight = unit_weight;
  ground.surcharge = surcharge;
  ground.preparation.preparation_friction = choice.preparation_friction;
  Sand sand;
  sand.law = law;
  sand.source = ground.make<Grains>(law, depths(layer));
  sand.strain_per_step = choice.strain_per_step;
  sand.least_steps = choice.least_dem_steps;
  sand.unbalanced_tolerance = choice.unbalanced_tolerance;
  sand.loose_pressure = surcharge / 2.0;
  return sand;
}

inline FrictionalSoil make_frictional_soil() {
  constexpr double degree = std::numbers::pi / 180.0;
  scarp::Strength const peak{.cohesion = 1e3, .friction = 30.8 * degree, .dilation = 6.6 * degree};
  scarp::Strength const residual{.cohesion = 1e3, .friction = (30.8 - 0.8 * 6.6) * degree, .dilation = 0.0};
  return {{soil_elasticity(), {.peak = peak, .residual = residual, .strain_to_residual = 0.15}, ground_at_rest()}};
}

inline ElasticSoil make_elastic_soil() { return {{soil_elasticity(), ground_at_rest()}}; }

}  // namespace fault_rupture

// SPDX-License-Identifier: BSL-1.0
#include <numbers>

#include "fault_rows.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/softening_strength.hpp"
#include "scarp/solver/consistent_tangent.hpp"

namespace nonlocal_band {

namespace {

using Local = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength>;
using Newton = scarp::QuasiNewton<scarp::ConsistentTangent>;

struct Soil : scarp::Nonlocal<Local> {};
struct Scene : scarp::FreeFieldFault<Soil, Newton> {};

constexpr double degree = std::numbers::pi / 180.0;

/// The soil of the example fault_rupture: the study's angles at the peak, 15 % of plastic shear to the residual
/// strength.
Local softening_sand() {
  scarp::Strength const peak{.cohesion = 1e3, .friction = 30.8 * degree, .dilation = 6.6 * degree};
  scarp::Strength const residual{.cohesion = 1e3, .friction = (30.8 - 0.8 * 6.6) * degree, .dilation = 0.0};
  return {scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25),
          {peak, residual, 0.15},
          {.surcharge = 4e3, .unit_weight = 15.68e3, .k0 = 0.4}};
}

}  // namespace

void print_fault(FaultChoice const& choice) {
  print_rows(choice, [](double size) {
    Scene scene;
    scene.soil.provider = softening_sand();
    scene.layer.size = size;
    scene.solver.rule.floor = 1e-4;
    scene.stepping.largest_gradient = 0.02;
    return scene;
  });
}

}  // namespace nonlocal_band

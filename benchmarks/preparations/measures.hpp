// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>

#include "../../examples/rve_biaxial/strength.hpp"
#include "../../examples/shared/sliding_contacts.hpp"
#include "../shared/condensed_tangent.hpp"
#include "column.hpp"

namespace preparations {

/// Packing of one depth in numbers; compression and contraction positive.
struct Measures {
  double k0 = 0.0;
  double void_ratio = 0.0;
  double coordination = 0.0;
  double mechanical_coordination = 0.0;
  double contact_fabric = 0.0;
  double particle_fabric = 0.0;
  double level_particle_fabric = 0.0;  ///< its part along the horizontal, negative along the vertical
  double sliding_share = 0.0;
  double lateral_strain = 0.0;   ///< logarithmic, since the isotropic state
  double vertical_strain = 0.0;  ///< logarithmic, since the isotropic state
};

/// Results of a drained biaxial test of the packing, and its elastic K0.
struct Tested {
  double friction_angle = std::numeric_limits<double>::quiet_NaN();         ///< [degrees], window of 5 %
  double narrow_friction_angle = std::numeric_limits<double>::quiet_NaN();  ///< [degrees], window of 0.5 %
  double dilation_angle = std::numeric_limits<double>::quiet_NaN();         ///< [degrees], secant
  double elastic_k0 = std::numeric_limits<double>::quiet_NaN();
};

inline Measures measure(AtDepth const& depth) {
  auto const law = examples::study_law();
  auto const& packing = depth.prepared.packing;
  auto const state = scarp::balance(packing, law);
  auto const [fabric, contacts] = scarp::contact_network(packing, law);
  auto const grains = scarp::particle_fabric(packing);
  return {.k0 = state.stress(0, 0) / state.stress(1, 1),
          .void_ratio = packing.void_ratio(),
          .coordination = contacts.all,
          .mechanical_coordination = contacts.mechanical,
          .contact_fabric = scarp::fabric_anisotropy(fabric),
          .particle_fabric = scarp::fabric_anisotropy(grains),
          .level_particle_fabric = scarp::fabric_deviator(grains)(0, 0),
          .sliding_share = examples::sliding_share(packing, law),
          .lateral_strain = -std::log(packing.cell(0, 0) / depth.first_cell(0, 0)),
          .vertical_strain = -std::log(packing.cell(1, 1) / depth.first_cell(1, 1))};
}

/// Consolidated isotropically at 200 kPa, then sheared as in examples/rve_biaxial, five times as fast.
inline Tested test(Packing packing) {
  auto const law = examples::study_law();
  Tested tested;
  // Every contact with its whole tangential spring: no contact slides.
  auto const tangent = benchmarks::CondensedTangent{.sliding = {.shear_share = 1.0}}(packing, law);
  tested.elastic_k0 = tangent(0, 1) / tangent(1, 1);
  rve_biaxial::Choice const choice{.strain_per_step = 1e-5};
  scarp::IsotropicPreparation const consolidation{.pressure = choice.pressure, .preparation_friction = law.friction};
  auto prepared = consolidation.prepare(std::move(packing), law);
  if (!prepared.verdict.acceptable()) return tested;
  rve_biaxial::Result result{};
  rve_biaxial::compress(std::move(prepared.packing), choice, result);
  if (!result.sheared.acceptable()) return tested;
  tested.friction_angle = rve_biaxial::peak_angles(result.rows, 0.05).friction_angle;
  tested.narrow_friction_angle = rve_biaxial::peak_angles(result.rows, 0.005).friction_angle;
  tested.dilation_angle = rve_biaxial::secant_dilation_angle(result.rows);
  return tested;
}

}  // namespace preparations

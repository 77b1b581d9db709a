// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "choice.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/constitutive/strength.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/rve/random_packings.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace fault_rupture {

using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;

/// Columns of packings, of which every point draws one.
using Columns = scarp::RandomChoice<scarp::PackingsByDepth<Grains>>;

/// The reference study's ellipses, consolidated under the overburden of every depth; the solver learns tangents from
/// responses. Where they lose all contacts a small stiffness keeps the nodes in place.
struct Sand : scarp::StiffnessFloor<scarp::DemRve<Grains, Columns>> {
  /// The next step corrects what one leaves unbalanced.
  static double tolerance(Choice const&) { return 1e-2; }
  static double max_displacement_gradient(bool quick) { return quick ? 0.02 : 0.0025; }
};

/// Mohr-Coulomb, by default with the reference study's angles at the peak, 30.8 and 6.6 degrees, and Bolton's angle at
/// constant volume, phi - 0.8 psi (Geotechnique 36, 1986), after 15 % of plastic shear; cohesion of 1 kPa; stiffness
/// near that of the packings.
struct FrictionalSoil : scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength> {
  static constexpr double tangent_floor = 1e-4;  ///< of the solver's rule
  /// Where a point is just at the corner of its yield surface, iterations may go round and round at 1e-10 to 1e-8.
  static double tolerance(Choice const&) { return 1e-8; }
  static double max_displacement_gradient(bool) { return 0.02; }
};

struct ElasticSoil : scarp::LinearElastic<2, scarp::GeostaticStress<2>> {
  static double tolerance(Choice const&) { return 1e-10; }
  static double max_displacement_gradient(bool) { return 0.02; }
};

/// Depths [m] at which points draw each column of packings, increasing, for each layer apart: those of the first column
/// come first. An image goes with what it mirrors.
/// sites: of all points that will be sand
std::vector<std::vector<double>> drawn_depths(Choice const& choice, std::vector<scarp::Site<2>> const& sites);

/// sites: of all points that will be sand
/// \throws scarp::PreparationError
Sand make_sand(Choice const& choice, std::vector<scarp::Site<2>> const& sites);
/// \throws scarp::InputError for angles that do not fit together
FrictionalSoil make_frictional_soil(Choice const& choice = {});
ElasticSoil make_elastic_soil(Choice const& choice = {});

}  // namespace fault_rupture

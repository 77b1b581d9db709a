// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/sphere.hpp"

namespace triaxial_column {

using Packing = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;
using Sand = scarp::DemRve<Packing, scarp::SamePacking<Packing>>;

/// What the user may choose.
struct Choice {
  int grains = 200;
  std::uint64_t seed = 2;
  double pressure = 1e5;    ///< confining [Pa]
  double strain = 0.02;     ///< shortening over height at the end
  double load_step = 1e-3;  ///< largest shortening of one load step
  double tolerance = 5e-3;  ///< residual of a load step
};

inline scarp::LinearFrictional contact_law() {
  return {.normal_stiffness = 1e6, .tangential_stiffness = 5e5, .friction = 0.5};
}

inline scarp::Prepared<Packing> consolidated(Choice const& choice) {
  scarp::Cloud<scarp::SphereGrading> const cloud{
      .grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = choice.grains, .density = 2650.0, .seed = choice.seed};
  return scarp::IsotropicPreparation{.pressure = choice.pressure}.prepare(cloud.make<Packing>(), contact_law());
}

/// Compression positive. Strains are logarithmic.
struct Row {
  double axial_strain = 0.0;
  double axial_stress = 0.0;  ///< Cauchy, mean over the volume [Pa]
  double volumetric_strain = 0.0;
  double spread = 0.0;  ///< largest distance of a point's axial stress from the mean, relative
};

}  // namespace triaxial_column

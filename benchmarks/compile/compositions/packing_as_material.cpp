// SPDX-License-Identifier: BSL-1.0
// A packing as constitutive law, one response: DEM and homogenisation, no finite elements.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/ellipse.hpp"

int main() {
  using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
  scarp::Cloud<scarp::EllipseGrading> const cloud{.grading = {.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75},
                                                  .grains = 100,
                                                  .density = 2650.0,
                                                  .thickness = 0.2};
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  auto const prepared = scarp::IsotropicPreparation{.pressure = 1e5}.prepare(cloud.make<Grains>(), law);
  if (!prepared.verdict.acceptable()) return 1;
  scarp::DemRve<Grains, scarp::SamePacking<Grains>> sand;
  sand.law = law;
  sand.source.packing = prepared.packing;
  scarp::Gradient<2> gradient = scarp::Gradient<2>::Zero();
  gradient(0, 1) = 1e-4;
  auto const start = sand.initial_state({});
  auto trial = start;
  return sand.respond(start, gradient, trial).verdict.acceptable() ? 0 : 1;
}

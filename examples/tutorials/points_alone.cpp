// SPDX-License-Identifier: BSL-1.0
// Material points without elements: a biaxial test of drained ground at three cell pressures.
#include "lattice.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/points/material_points.hpp"

int main() {
  // The pressure of each point's cell [Pa] is that of its depth.
  scarp::MohrCoulomb<2, scarp::GeostaticStress<2>> const soil{scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3),
                                                              {{.friction = 0.6, .dilation = 0.1}},
                                                              {.unit_weight = 1e4}};
  std::vector<scarp::Site<2>> sites;
  for (int k = 0; k < 3; ++k) sites.push_back({.index = k, .depth = 5.0 * (k + 1)});
  scarp::MaterialPoints<2> points(soil, sites);
  scarp::SerialExecutor executor;

  for (int step = 0; step < 40; ++step) {
    for (int k = 0; k < points.size(); ++k) points.gradient(k) = scarp::Gradient<2>{{0.0, 0.0}, {0.0, -1e-3}};
    double missing = 1.0;  // of the largest lateral stress, relative
    for (int iteration = 0; iteration < 50 && missing > 1e-10; ++iteration) {
      if (!points.respond(executor).verdict.acceptable()) return 1;
      missing = 0.0;
      for (int k = 0; k < points.size(); ++k) {
        double const pressure = 1e4 * sites[static_cast<std::size_t>(k)].depth;
        double const more = points.stress(k)(0) + pressure;
        points.gradient(k)(0, 0) -= more / points.initial_tangent(k)(0, 0);
        missing = std::max(missing, std::abs(more) / pressure);
      }
    }
    points.commit();
  }
  bool good = true;
  for (int k = 0; k < points.size(); ++k) {
    auto const stress = points.committed_stress(k);
    double const known = (1.0 + std::sin(0.6)) / (1.0 - std::sin(0.6));  // ratio of principal stresses
    good &= tutorials::agree("axial over lateral stress", stress(1) / stress(0), known, 1e-8);
  }
  return good ? 0 : 1;
}

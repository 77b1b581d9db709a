// SPDX-License-Identifier: BSL-1.0
// A packing as the material of another program: a C function takes the gradient and returns stress and tangent.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/disc.hpp"

#include "lattice.hpp"

using Grains = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;
using Soil = scarp::DemRve<Grains, scarp::SamePacking<Grains>>;

/// What C sees as an opaque pointer: the parameters and a point's committed and trial state.
struct scarp_point {
  Soil soil;
  Soil::State committed, trial;
};

// Exceptions must not leave a C function: wrong input returns null or 2.
extern "C" {
/// A point of a square lattice of discs, 1 m thick. stiffness [N/m], radius and overlap [m]; null for wrong input.
scarp_point* scarp_point_new(double stiffness, double friction, double radius, double overlap) try {
  double const spacing = 2.0 * radius - overlap;
  Soil const soil{.law = {.normal_stiffness = stiffness, .tangential_stiffness = stiffness, .friction = friction},
                  .source = {tutorials::lattice<Grains>({radius}, {spacing, spacing})}};
  auto const start = soil.initial_state({});
  return new scarp_point{soil, start, start};
} catch (...) {
  return nullptr;
}
void scarp_point_free(scarp_point* point) { delete point; }

/// gradient: d u_i / d x_j since the committed state, rows first [4]; stress: xx, yy, xy [Pa], tension positive [3];
/// tangent: d stress / d (eps_xx, eps_yy, gamma_xy), rows first [9].
/// \return 0; 1 where the packing could not follow (the numbers are then of no use); 2 for wrong input
int scarp_point_respond(scarp_point* point, double const* gradient, double* stress, double* tangent) try {
  scarp::Gradient<2> const increment{{gradient[0], gradient[1]}, {gradient[2], gradient[3]}};
  auto const response = point->soil.respond(point->committed, increment, point->trial);
  Eigen::Map<scarp::VoigtStress<2>>{stress} = response.stress;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{tangent} = point->soil.tangent(point->trial);
  return response.verdict.acceptable() ? 0 : 1;
} catch (...) {
  return 2;
}
/// Makes the last response the state that further gradients count from.
void scarp_point_commit(scarp_point* point) { point->committed = point->trial; }
}

int main() {
  double const stiffness = 6e6, radius = 5e-3, overlap = 1e-6, strain = 1e-5;
  scarp_point* const point = scarp_point_new(stiffness, 0.5, radius, overlap);
  if (point == nullptr) return 1;
  double const squeeze[4] = {-strain, 0.0, 0.0, 0.0};
  double stress[3], tangent[9];
  bool good = scarp_point_respond(point, squeeze, stress, tangent) == 0;
  // One contact of force k u in each spacing d: stress k u / d, and C11 = k in a lattice 1 m thick.
  double const spacing = 2.0 * radius - overlap;
  double const closer = spacing * std::exp(-std::log1p(strain));
  good &= tutorials::agree("stress across [Pa]", -stress[1], stiffness * overlap / closer, 1e-4);
  good &= tutorials::agree("stress along [Pa]", -stress[0], stiffness * (overlap / spacing + strain), 1e-4);
  good &= tutorials::agree("tangent xx, xx [Pa]", tangent[0], stiffness, 1e-4);
  scarp_point_commit(point);
  double const still[4] = {};
  good &= scarp_point_respond(point, still, stress, tangent) == 0;
  good &= tutorials::agree("stress along after the commit [Pa]", -stress[0], stiffness * (overlap / spacing + strain),
                           1e-4);
  scarp_point_free(point);
  return good && scarp_point_new(-1.0, 0.5, radius, overlap) == nullptr ? 0 : 1;
}

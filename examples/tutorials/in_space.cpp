// SPDX-License-Identifier: BSL-1.0
// Packings in space: the shape sets the dimension of everything; three tests of a packing of spheres.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/sphere.hpp"

#include "lattice.hpp"

int main() {
  using Spheres = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;
  scarp::LinearFrictional const law{.normal_stiffness = 6e5, .tangential_stiffness = 4e5, .friction = 0.5};
  double const radius = 5e-3, overlap = 1e-5, spacing = 2.0 * radius - overlap;
  // As material of a scene: Region{"soil", soil} on a mesh of Hex8, Hex20, Tet4 or Tet10.
  scarp::DemRve const soil{law, tutorials::lattice<Spheres>({radius}, {spacing, spacing, spacing}, 3)};
  auto const start = soil.initial_state({});
  bool good = true;
  // After an increment of the displacement gradient from the start: xx, yy, zz, yz, zx, xy [Pa], tension positive.
  auto const stress_after = [&](scarp::Gradient<3> const& increment) {
    auto state = start;
    auto const response = advance(soil, state, increment);
    good &= response.verdict.acceptable();
    return response.stress;
  };

  // A cubic lattice: one contact of force k u on the area d d of each cell.
  double const strain = 1e-4, force = law.normal_stiffness * overlap, shorter = spacing * (1.0 - strain);
  scarp::Gradient<3> pressed = scarp::Gradient<3>::Zero();
  pressed(2, 2) = -strain;
  auto const stress = stress_after(pressed);
  good &= tutorials::agree("stress along z [Pa]", -stress(2),
                           law.normal_stiffness * (2.0 * radius - shorter) / (spacing * spacing), 1e-6);
  good &= tutorials::agree("stress along x [Pa]", -stress(0), force / (spacing * shorter), 1e-6);

  // Pure shear e in one plane: both kinds of contact slip by e d; the branches turn, which subtracts 2 p e.
  scarp::Gradient<3> sheared = scarp::Gradient<3>::Zero();
  sheared(0, 1) = sheared(1, 0) = strain;
  double const pressure = force / (spacing * spacing);
  good &= tutorials::agree("stress xy [Pa]", stress_after(sheared)(5),
                           (law.tangential_stiffness / spacing - 2.0 * pressure) * strain, 1e-3);
  auto const tangent = soil.tangent(start);
  good &= tutorials::agree("tangent zz, zz [Pa]", tangent(2, 2), law.normal_stiffness / spacing, 1e-9);
  return good ? 0 : 1;
}

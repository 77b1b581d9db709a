// SPDX-License-Identifier: BSL-1.0
// What changes in space? The shape and the dimension: a hexahedron whose points carry packings of spheres, compressed.
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/packings_by_depth.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/element/hex8.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/scene/scene.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"

#include "lattice.hpp"

int main() {
  using Spheres = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;
  scarp::LinearFrictional const law{.normal_stiffness = 6e5, .tangential_stiffness = 6e5, .friction = 0.5};
  double const radius = 5e-3, overlap = 1e-6, spacing = 2.0 * radius - overlap, strain = 1e-4;
  scarp::DemRve<Spheres, scarp::SamePacking<Spheres>> const soil{
      .law = law, .source = {answers::lattice<Spheres>({radius}, {spacing, spacing, spacing}, 3)}};

  // One element pressed along z between walls that do not give way.
  auto const mesh = scarp::BoxMesh<scarp::Hex8>{}.generate();
  scarp::Discretisation<scarp::Hex8> const grid(mesh);
  scarp::Constraints fixed(mesh);
  for (int node = 0; node < grid.node_count(); ++node) {
    fixed.fix(node, 0);
    fixed.fix(node, 1);
  }
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) fixed.fix(node, 2);
  for (int const node : scarp::boundary_nodes(mesh, "top")) fixed.move(node, 2, -strain);
  auto const soils = boost::hana::make_tuple(scarp::Region{"soil", soil});
  scarp::SerialExecutor serial;
  auto problem = scarp::make_problem(grid, 1.0, soils, fixed, scarp::LoadHistory{}, serial);
  scarp::NoObserver nobody;
  auto const run = scarp::LoadStepping{.first = 1.0}.run(scarp::QuasiNewton<>{}, problem, 0.0, 1.0, nobody);

  // A cubic lattice: one contact of force k u on the area d d of each cell.
  double const shorter = spacing * (1.0 - strain);
  double const along = law.normal_stiffness * (2.0 * radius - shorter) / (spacing * spacing);
  double const across = law.normal_stiffness * overlap / (spacing * shorter);
  auto const stress = problem.committed_stresses().front();
  bool good = run.verdict.acceptable();
  good &= answers::agree("stress along z [Pa]", -stress(2), along, 1e-4);
  return answers::agree("stress along x [Pa]", -stress(0), across, 1e-4) && good ? 0 : 1;
}

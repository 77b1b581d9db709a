// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>
#include <limits>

#include "../shared/elastic_solve.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/mesh/box_mesh.hpp"

namespace cook_membrane {

/// Cook's tapered panel in plane strain: corners (0, 0), (48, 44), (48, 60), (0, 44) m, thickness 1 m, left side
/// clamped, a total force of 1 N upwards spread evenly over the right side. Geometry: Cook, J. Struct. Div. ASCE 100
/// (1974) 1851; Young's modulus as in Simo and Armero, Int. J. Numer. Meth. Engng 33 (1992) 1413.
struct Panel {
  double young = 240.565;   ///< [Pa]
  double poisson = 0.4999;  ///< bulk modulus 5000 times the shear modulus
  double force = 1.0;       ///< [N]
};

inline scarp::Vector<2> taper(scarp::Vector<2> const& box) {
  double const lower = 44.0 * box.x();
  double const upper = 44.0 + 16.0 * box.x();
  return {48.0 * box.x(), lower + box.y() * (upper - lower)};
}

struct Outcome {
  int cells = 0;  ///< along each side
  int dofs = 0;
  double deflection = 0.0;  ///< of the corner (48, 60), upwards [m]
  double middle = 0.0;      ///< the same at (48, 52); NaN for an odd number of cells
  double seconds = 0.0;     ///< of the sparsity, assembly and direct solve
};

template <class Element, class Scheme>
Outcome solve(int cells, Panel const& panel = {}) {
  auto const mesh = scarp::BoxMesh<Element>{.cells = {cells, cells}, .map = taper}.generate();
  auto const start = std::chrono::steady_clock::now();
  scarp::Discretisation<Element, scarp::SmallStrain, Scheme> const grid(mesh);
  scarp::Constraints constraints(mesh);
  for (int const node : boundary_nodes(mesh, "left")) {
    constraints.fix(node);
  }
  auto const solid = scarp::LinearElastic<2>::from_young_poisson(panel.young, panel.poisson);
  auto const load = grid.traction("right", scarp::Vector<2>(0.0, panel.force / 16.0));
  auto const moved = examples::elastic_solve(grid, solid, constraints, Eigen::VectorXd::Zero(grid.dof_count()), load);
  std::chrono::duration<double> const took = std::chrono::steady_clock::now() - start;
  int const corner = (cells + 1) * (cells + 1) - 1;  // corners come before the nodes on edges
  int const middle = corner - (cells + 1) * (cells / 2);
  return {cells, grid.dof_count(), moved(2 * corner + 1),
          cells % 2 == 0 ? moved(2 * middle + 1) : std::numeric_limits<double>::quiet_NaN(), took.count()};
}

}  // namespace cook_membrane

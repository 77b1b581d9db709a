// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <vector>

#include "../shared/convergence_table.hpp"
#include "../shared/plane_strain.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/strength.hpp"
#include "scarp/constitutive/varied_parameters.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace nonlocal_band {

using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength>;
using Varied = scarp::VariedParameters<Soil>;
using Grid = examples::PlaneGrid<scarp::Quad8, scarp::ReducedIntegration>;
using Problem = scarp::EquilibriumProblem<Grid>;

inline constexpr double pressure = 100e3;  ///< that confines the specimen [Pa]
inline constexpr double width = 1.0;       ///< [m]
inline constexpr double height = 2.0;      ///< [m]

inline scarp::Strength strength(double cohesion, double friction, double dilation) {
  return {cohesion, examples::radians(friction), examples::radians(dilation)};
}

/// Softens from 35 to 30 degrees; weaker by a few kilopascals of cohesion near the origin, in a spot that no mesh
/// knows.
inline Varied soil() {
  Soil const common{scarp::IsotropicElasticity::from_young_poisson(50e6, 0.3),
                    {strength(10e3, 35.0, 5.0), strength(1e3, 30.0, 5.0), 0.1},
                    {.surcharge = pressure}};
  return {common, [](Soil soil, scarp::Site<2> const& site) {
            double const weakness = 4e3 * std::exp(-site.position.squaredNorm() / (0.2 * 0.2));
            soil.strength.peak.cohesion -= weakness;
            return soil;
          }};
}

/// A quarter of a biaxial specimen between smooth platens in small strain; the load factor is the settlement [m] of its
/// top.
inline Problem specimen(int cells, scarp::Neighbourhood neighbourhood, scarp::ThreadExecutor& executor) {
  auto const mesh = scarp::BoxMesh<scarp::Quad8>{.lengths = {width, height}, .cells = {cells, 2 * cells}}.generate();
  Grid grid(mesh);
  scarp::Constraints constraints(mesh);
  for (int const node : scarp::boundary_nodes(mesh, "left")) constraints.fix(node, 0);
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) constraints.fix(node, 1);
  for (int const node : scarp::boundary_nodes(mesh, "top")) constraints.move(node, 1, -1.0);
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, height));
  auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
  scarp::Nonlocal<Varied> const nonlocal{soil(), neighbourhood.length, neighbourhood.stiffness, neighbourhood.fading};
  scarp::MaterialPoints<2> points(nonlocal, sites, volumes);
  auto loads = grid.traction("right", scarp::Vector<2>(-pressure, 0.0));
  return {std::move(grid), std::move(points), std::move(constraints), scarp::LoadHistory(loads), executor};
}

}  // namespace nonlocal_band

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <numbers>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/strength.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "support/crossed_rectangle.hpp"

namespace stability {

using SofteningSoil = scarp::MohrCoulomb<2, scarp::StressFree<2>, scarp::SofteningStrength>;

inline SofteningSoil ground(double residual_cohesion = 20e3) {
  constexpr double degree = std::numbers::pi / 180.0;
  scarp::Strength const peak{.cohesion = 20e3, .friction = 30.0 * degree, .dilation = 0.0};
  scarp::Strength residual = peak;
  residual.cohesion = residual_cohesion;
  return {.elasticity = scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25),
          .strength = {.peak = peak, .residual = residual, .softening_strain = 0.05},
          .initial = {}};
}

/// Block of 1 m x 2 m of crossed triangles on a rough base. The load factor presses a rough top down [m], or is a
/// pressure on a free one [Pa], or nothing holds the base along x.
struct Block {
  enum class Top { pressed, loaded };

  using Grid = scarp::Discretisation<scarp::Tri3>;
  using Problem = scarp::EquilibriumProblem<Grid>;

  SofteningSoil material = ground();
  Top top = Top::pressed;
  bool base_held = true;
  int columns = 3;

  Problem make() const {
    static scarp::SerialExecutor executor;
    Grid grid(
        samples::CrossedRectangle{.width = 1.0, .height = 2.0, .columns = columns, .rows = 2 * columns}.generate());
    scarp::Constraints constraints(grid.mesh());
    for (int const node : boundary_nodes(grid.mesh(), "bottom")) {
      constraints.fix(node, 1);
      if (base_held) constraints.fix(node, 0);
    }
    scarp::LoadHistory loads(Eigen::VectorXd::Zero(grid.dof_count()));
    if (top == Top::loaded) {
      loads.add(grid.traction("top", scarp::Vector<2>(0.0, -1.0)), {});
    } else {
      for (int const node : boundary_nodes(grid.mesh(), "top")) {
        if (base_held) constraints.fix(node, 0);
        constraints.move(node, 1, -1.0);
      }
    }
    std::vector<scarp::Site<2>> sites;
    for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 2.0));
    return {std::move(grid), {material, sites}, std::move(constraints), std::move(loads), executor};
  }
};

}  // namespace stability

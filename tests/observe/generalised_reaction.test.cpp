// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/generalised_reaction.hpp"

#include <doctest/doctest.h>

#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/crossed_rectangle.hpp"

namespace {

using Soil = scarp::LinearElastic<2>;
using Grid = scarp::Discretisation<scarp::Tri3, scarp::SmallStrain>;

/// Of a square of 1 m between rough plates, whose upper one goes down by the load.
double reaction(Grid grid, scarp::MaterialPoints<2> points, double rate, double load) {
  scarp::Constraints constraints(grid.mesh());
  for (int node = 0; node < grid.node_count(); ++node) {
    double const height = grid.mesh().nodes[static_cast<std::size_t>(node)].y();
    constraints.fix(node, 0);
    if (height == 0.0) constraints.fix(node, 1);
    if (height == 1.0) constraints.move(node, 1, rate);
  }
  scarp::SerialExecutor serial;
  scarp::EquilibriumProblem<Grid> problem(std::move(grid), std::move(points), std::move(constraints), {}, serial);
  scarp::NoObserver no_observer;
  CHECK(scarp::generalised_reaction(problem) == 0.0);
  CHECK(scarp::LoadStepping{}.run(scarp::QuasiNewton<>{}, problem, 0.0, load, no_observer).verdict == scarp::Verdict{});
  return scarp::generalised_reaction(problem);
}

}  // namespace

TEST_CASE("the generalised reaction of a pressed square is modulus times strain, as work per unit of the load factor") {
  auto const soil = Soil::from_young_poisson(20e6, 0.3);
  Grid const grid(samples::CrossedRectangle{.columns = 3, .rows = 3}.generate());
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  scarp::MaterialPoints<2> const points(soil, sites);
  // Analytic: uniaxial compression, to the strain's square.
  double const modulus = soil.elasticity.lame_lambda + 2.0 * soil.elasticity.shear_modulus;
  constexpr double load = 1e-4;
  CHECK(std::abs(reaction(grid, points, -1.0, load) / (load * modulus) - 1.0) < 2.0 * load);
  // Twice the motion: twice the force, on twice the way.
  CHECK(std::abs(reaction(grid, points, -2.0, load) / (4.0 * load * modulus) - 1.0) < 4.0 * load);
}

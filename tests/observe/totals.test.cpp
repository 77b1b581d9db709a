// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/totals.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/approx.hpp"
#include "support/block.hpp"
#include "support/crossed_rectangle.hpp"
#include "support/packings.hpp"

namespace {

using Rve = scarp::DemRve<samples::Discs, scarp::SamePacking<samples::Discs>>;
using Sand = samples::Block<Rve, scarp::UpdatedLagrangian>;

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

TEST_CASE("solids neither come nor go with packings that deform as their elements") {
  scarp::SerialExecutor executor;
  Rve const sand{.law = samples::study_law(),
                 .source = {samples::consolidated<samples::Discs>(25).packing},
                 .strain_per_step = 4e-5};
  double const whole = 1.0 / (1.0 + sand.source.packing.void_ratio());  // [m2], of 1 m2 of ground
  auto const change = [&](auto& problem) {
    CHECK(scarp::solid_volume(problem) == samples::Approx(whole).epsilon(1e-12));
    for (int step = 0; step < 3; ++step) {  // elements shrink and grow by up to a third
      Eigen::VectorXd moves = Eigen::VectorXd::Zero(problem.dof_count());
      for (Eigen::Index k = 0; k < moves.size(); ++k) moves(k) = 0.01 * static_cast<double>((3 + k * k) % 5);
      REQUIRE(problem.plan(moves).acceptable());
      static_cast<void>(problem.evaluate(moves));  // volumes need no balance
      problem.commit(moves);
    }
    return scarp::solid_volume(problem) / whole - 1.0;
  };
  auto local = Sand::make(sand, executor);
  auto const& grid = local.discretisation();
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
  Sand::Problem with_means(grid, {scarp::Nonlocal<Rve>{sand, 0.6}, sites, volumes}, local.constraints(), local.loads(),
                           executor);
  CHECK(std::abs(change(local)) < 1e-12);
  // Near the sides a point counts more for its neighbours than they do for it.
  double const missed = std::abs(change(with_means));
  CHECK(missed > 1e-4);
  CHECK(missed < 1e-2);
  auto const elastic = samples::Block<scarp::LinearElastic<2>>::make(samples::elastic_soil(), executor);
  CHECK(scarp::solid_volume(elastic) == 0.0);
}

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

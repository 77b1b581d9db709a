// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/solid_volume.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "scarp/points/nonlocal.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "support/approx.hpp"
#include "support/block.hpp"
#include "support/packings.hpp"

namespace {

using Rve = scarp::DemRve<samples::Discs, scarp::SamePacking<samples::Discs>>;
using Sand = samples::Block<Rve, scarp::UpdatedLagrangian>;

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

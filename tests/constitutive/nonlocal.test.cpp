// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/nonlocal.hpp"

#include <doctest/doctest.h>

#include <random>

#include "scarp/constitutive/nonlocal_materials.hpp"
#include "scarp/io/state_bits.hpp"
#include "scarp/solver/wide_equations.hpp"
#include "solver/sample_block.hpp"

namespace {

using Elastic = scarp::LinearElastic<2>;
using Local = sample::Block<sample::Softening, scarp::UpdatedLagrangian>;
using Materials = scarp::NonlocalMaterials<scarp::ProviderField<sample::Softening>>;
using Problem = scarp::EquilibriumProblem<Local::Grid, Materials, scarp::SerialExecutor>;

static_assert(scarp::AveragesGradients<Materials>);
static_assert(!scarp::AveragesGradients<scarp::ProviderField<Elastic>>);
static_assert(scarp::AsksForMeans<scarp::Nonlocal<Elastic>> && !scarp::AsksForMeans<Elastic>);

std::vector<scarp::Site<2>> sites(Local::Grid const& grid) {
  std::vector<scarp::Site<2>> all;
  for (int point = 0; point < grid.point_count(); ++point) all.push_back(grid.site(point, 1.0));
  return all;
}

std::vector<double> volumes(Local::Grid const& grid) { return grid.volumes(Eigen::VectorXd::Zero(grid.dof_count())); }

/// The block of the solvers' tests with points that look around themselves.
Problem block(scarp::Neighbourhood const& neighbourhood, sample::Softening const& soil,
              scarp::SerialExecutor& executor) {
  auto const local = Local::make(soil, executor);
  auto const& grid = local.discretisation();
  std::vector<scarp::Neighbourhood> const all(sites(grid).size(), neighbourhood);
  return {grid, Materials(local.materials(), sites(grid), volumes(grid), all), local.constraints(), local.loads(),
          executor};
}

/// Uneven displacements of all nodes [m].
Eigen::VectorXd uneven(Eigen::Index size, double largest) {
  std::mt19937 random(7);
  Eigen::VectorXd moves(size);
  for (auto& move : moves) move = largest * (2.0 * static_cast<double>(random() % 1000) / 999.0 - 1.0);
  return moves;
}

}  // namespace

TEST_CASE("means keep what is even, stay within a region, and are none for a point alone") {
  Local::Grid const grid(scarp::RectangleMesh{.columns = 3, .rows = 2}.generate());
  auto where = sites(grid);
  for (auto& site : where) site.region = site.position.x() < 0.5 ? 0 : 1;
  std::vector<double> lengths(where.size(), 0.6);
  lengths[3] = 0.0;
  scarp::NeighbourMean<2> const mean(where, volumes(grid), lengths);
  CHECK_FALSE(mean.is_local());
  std::vector<double> const even(where.size(), 7.0);
  for (int point = 0; point < mean.point_count(); ++point) {
    auto const k = static_cast<std::size_t>(point);
    CHECK(mean.mean(point, std::span<double const>(even)) == doctest::Approx(7.0).epsilon(1e-14));
    CHECK((mean.of(point).size() == 1) == (point == 3));
    int last = -1;
    for (auto const& share : mean.of(point)) {
      auto const j = static_cast<std::size_t>(share.point);
      CHECK(share.point > last);
      last = share.point;
      CHECK(where[j].region == where[k].region);
      CHECK((where[j].position - where[k].position).norm() < 0.6);
      CHECK(share.weight > 0.0);
    }
  }
  CHECK(mean.of(3)[0].weight == 1.0);
  lengths[5] = -1.0;
  CHECK_THROWS_AS((scarp::NeighbourMean<2>(where, volumes(grid), lengths)), scarp::InputError);
}

TEST_CASE("a length of zero, or one that reaches no neighbour, gives the local answer bit for bit") {
  scarp::SerialExecutor executor;
  sample::Softening const soil{.reference_strain = 0.02};
  scarp::QuasiNewton<> const solver{.tolerance = 1e-6};
  scarp::NoObserver nobody;
  auto local = Local::make(soil, executor);
  auto const expected = scarp::LoadStepping{.first = 0.005}.run(solver, local, 0.0, 0.01, nobody);
  REQUIRE(expected.verdict.acceptable());
  REQUIRE(expected.iterations > 2 * expected.steps);
  for (double const length : {0.0, 1e-3}) {
    auto problem = block({.length = length}, soil, executor);
    auto const run = scarp::LoadStepping{.first = 0.005}.run(solver, problem, 0.0, 0.01, nobody);
    CHECK(run.iterations == expected.iterations);
    CHECK(problem.discretisation().positions() == local.discretisation().positions());
    CHECK(problem.committed_stresses() == local.committed_stresses());
  }
  // The same with a length does something else.
  auto other = block({.length = 0.5}, soil, executor);
  CHECK(scarp::LoadStepping{.first = 0.005}.run(solver, other, 0.0, 0.01, nobody).verdict.acceptable());
  CHECK(other.discretisation().positions() != local.discretisation().positions());
}

TEST_CASE("a field that was saved and loaded goes on with the same bits") {
  scarp::SerialExecutor executor;
  sample::Softening const soil{.reference_strain = 0.02};
  Problem first = block({.length = 0.6}, soil, executor);
  Eigen::VectorXd const moves = uneven(first.dof_count(), 0.01);
  first.plan(moves);
  first.evaluate(moves);
  first.commit(moves);
  scarp::StateWriter writer;
  writer("problem", std::as_const(first));
  Problem second = block({.length = 0.6}, soil, executor);
  scarp::StateReader reader(writer.bits());
  reader("problem", second);
  CHECK(reader.at_end());
  for (Problem* problem : {&first, &second}) problem->plan(-0.5 * moves);
  auto const one = first.evaluate(-0.5 * moves);
  auto const other = second.evaluate(-0.5 * moves);
  CHECK(first.materials().added_stresses() == second.materials().added_stresses());
  CHECK(first.materials().added_stresses()[0].norm() > 0.0);
  CHECK(one.unbalanced == other.unbalanced);
}

TEST_CASE("the wide stiffness is the derivative of the forces, fading included") {
  scarp::SerialExecutor executor;
  auto problem = block({.length = 0.6, .stiffness = 0.7, .fading = 2e-4}, {}, executor);
  // Small enough that the configuration's own change, of which the spin counts as local, stays below the tolerance.
  Eigen::VectorXd const start = uneven(problem.dof_count(), 1e-5);
  problem.evaluate(start);
  problem.commit(start);
  Eigen::VectorXd const at = uneven(problem.dof_count(), 1e-5);
  problem.evaluate(at);
  scarp::WideStiffness<2> matrix;
  problem.ground_stiffness(at, problem.trial_tangents(), matrix);
  Eigen::VectorXd const direction = uneven(problem.dof_count(), 1.0).reverse();
  constexpr double step = 1e-8;
  Eigen::VectorXd const more = problem.evaluate(at + step * direction).unbalanced;
  Eigen::VectorXd const less = problem.evaluate(at - step * direction).unbalanced;
  Eigen::VectorXd const difference = (more - less) / (2.0 * step);
  // Strains of 1e-4 change the geometry by as much; stresses are the same part of the moduli.
  CHECK((matrix * direction - difference).norm() <= 5e-4 * difference.norm());
  // What the local matrix would say is far away.
  auto const local = problem.discretisation().stiffness(at, problem.committed_stresses(), problem.trial_tangents());
  CHECK((local * direction - difference).norm() > 0.1 * difference.norm());
}

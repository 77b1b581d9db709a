// SPDX-License-Identifier: BSL-1.0
#include "scarp/points/nonlocal.hpp"

#include <doctest/doctest.h>

#include <boost/hana/tuple.hpp>
#include <random>

#include "scarp/io/state_bits.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/points/laboratory_paths.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/points/point_path.hpp"
#include "scarp/solver/linear_system.hpp"
#include "scarp/solver/make_problem.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "scarp/solver/work_balance.hpp"
#include "support/approx.hpp"
#include "support/block.hpp"
#include "support/refusals.hpp"

namespace {

using Elastic = scarp::LinearElastic<2>;
using Local = samples::Block<samples::Softening, scarp::UpdatedLagrangian>;
using Problem = Local::Problem;

static_assert(scarp::Material<scarp::Nonlocal<Elastic>> && !scarp::ConstitutiveProvider<scarp::Nonlocal<Elastic>>);
static_assert(!scarp::Material<scarp::Neighbourhood>);

std::vector<scarp::Site<2>> sites(Local::Grid const& grid) {
  std::vector<scarp::Site<2>> all;
  for (int point = 0; point < grid.point_count(); ++point) all.push_back(grid.site(point, 1.0));
  return all;
}

std::vector<double> volumes(Local::Grid const& grid) { return grid.volumes(Eigen::VectorXd::Zero(grid.dof_count())); }

scarp::Nonlocal<samples::Softening> wide(samples::Softening const& soil, scarp::Neighbourhood const& neighbourhood) {
  return {soil, neighbourhood.length, neighbourhood.stiffness, neighbourhood.fading};
}

/// The block of the solvers' tests with points that look around themselves.
/// alone: every so many points is a local one; 0 for none
Problem block(scarp::Neighbourhood const& neighbourhood, samples::Softening const& soil,
              scarp::SerialExecutor& executor, std::size_t alone = 0) {
  auto const local = Local::make(soil, executor);
  auto const& grid = local.discretisation();
  scarp::MaterialPoints<2> points(wide(soil, neighbourhood), sites(grid), volumes(grid));
  if (alone > 0) {
    std::vector<scarp::Neighbourhood> all(sites(grid).size(), neighbourhood);
    for (std::size_t k = 0; k < all.size(); k += alone) all[k].length = 0.0;
    points.average(scarp::point_means<2>(sites(grid), volumes(grid), all, points.committed_tangents(executor)));
  }
  return {grid, std::move(points), local.constraints(), local.loads(), executor};
}

scarp::SerialExecutor& serial() {
  static scarp::SerialExecutor executor;
  return executor;
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
  Local::Grid const grid(samples::CrossedRectangle{.columns = 3, .rows = 2}.generate());
  auto where = sites(grid);
  for (auto& site : where) site.region = site.position.x() < 0.5 ? 0 : 1;
  std::vector<double> lengths(where.size(), 0.6);
  lengths[3] = 0.0;
  scarp::NeighbourMean const mean = scarp::neighbour_mean<2>(where, volumes(grid), lengths);
  CHECK_FALSE(mean.is_local());
  std::vector<double> const even(where.size(), 7.0);
  for (int point = 0; point < mean.size(); ++point) {
    auto const k = static_cast<std::size_t>(point);
    CHECK(mean.mean(point, std::span<double const>(even), even) == samples::Approx(7.0).epsilon(1e-14));
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
  CHECK_REFUSED(scarp::neighbour_mean<2>(where, volumes(grid), lengths), "length", "is -1");
  lengths[5] = 0.6;
  auto negative = volumes(grid);
  negative[2] = -0.5;
  CHECK_REFUSED(scarp::neighbour_mean<2>(where, negative, lengths), "volume of a point is -0.5");
}

TEST_CASE("a length of zero, or one that reaches no neighbour, gives the local answer bit for bit") {
  scarp::SerialExecutor executor;
  samples::Softening const soil{.reference_strain = 0.02};
  scarp::QuasiNewton<> const solver{.tolerance = 1e-6};
  scarp::NoObserver no_observer;
  auto local = Local::make(soil, executor);
  auto const expected = scarp::LoadStepping{.first = 0.005}.run(solver, local, 0.0, 0.01, no_observer);
  REQUIRE(expected.verdict.acceptable());
  REQUIRE(expected.iterations > 2 * expected.steps);
  for (double const length : {0.0, 1e-3}) {
    auto problem = block({.length = length}, soil, executor);
    auto const run = scarp::LoadStepping{.first = 0.005}.run(solver, problem, 0.0, 0.01, no_observer);
    CHECK(run.iterations == expected.iterations);
    CHECK(problem.discretisation().positions() == local.discretisation().positions());
    CHECK(problem.committed_stresses() == local.committed_stresses());
  }
  // The same with a length does something else.
  auto other = block({.length = 0.5}, soil, executor);
  CHECK(scarp::LoadStepping{.first = 0.005}.run(solver, other, 0.0, 0.01, no_observer).verdict.acceptable());
  CHECK(other.discretisation().positions() != local.discretisation().positions());
}

TEST_CASE("points that were saved and loaded go on with the same bits") {
  scarp::SerialExecutor executor;
  samples::Softening const soil{.reference_strain = 0.02};
  Problem first = block({.length = 0.6}, soil, executor);
  Eigen::VectorXd const moves = uneven(first.dof_count(), 0.01);
  REQUIRE(first.plan(moves).acceptable());
  REQUIRE(first.evaluate(moves).verdict.acceptable());
  first.commit(moves);
  scarp::StateWriter writer;
  writer("problem", std::as_const(first));
  Problem second = block({.length = 0.6}, soil, executor);
  scarp::StateReader reader(writer.bits());
  reader("problem", second);
  CHECK(reader.at_end());
  for (Problem* problem : {&first, &second}) REQUIRE(problem->plan(-0.5 * moves).acceptable());
  auto const one = first.evaluate(-0.5 * moves);
  auto const other = second.evaluate(-0.5 * moves);
  CHECK(first.points().means()->added_stresses() == second.points().means()->added_stresses());
  CHECK(first.points().means()->added_stresses()[0].norm() > 0.0);
  CHECK(one.unbalanced == other.unbalanced);
}

TEST_CASE("the volume that points see is that of all of them, whatever each one does") {
  // Two points that see each other alike; their volumes are exp(x) and exp(-x) times the initial ones, all of it
  // cosh(x).
  scarp::NeighbourMean const alike({0, 2, 4}, {{0, 0.5}, {1, 0.5}, {0, 0.5}, {1, 0.5}});
  std::vector const neighbourhoods(2, scarp::Neighbourhood{.length = 1.0});
  scarp::NonlocalMeans<2> means(alike, neighbourhoods, std::vector(2, scarp::VoigtTangent<2>::Zero().eval()));
  scarp::SerialExecutor executor;
  constexpr int steps = 20;
  constexpr double whole = 0.5;
  std::array seen{1.0, 1.0};
  for (int step = 0; step < steps; ++step) {
    scarp::PointMeans<2>::Gradients own(2, scarp::Gradient<2>::Zero());
    own[0](0, 0) = std::expm1(whole / steps);
    own[1](1, 1) = std::expm1(-whole / steps);
    auto const mean = means.average(own, executor);
    for (std::size_t k = 0; k < 2; ++k) seen[k] *= 1.0 + mean[k].trace();
    means.commit();
  }
  for (double const volume : seen) CHECK(volume == samples::Approx(std::cosh(whole)).epsilon(1e-13));
  CHECK(means.committed(0).volume == samples::Approx(std::exp(whole)).epsilon(1e-13));
  scarp::PointMeans<2>::Gradients inverted(2, scarp::Gradient<2>::Zero());
  inverted[1](0, 0) = -1.5;
  means.average(inverted, executor);
  CHECK_REFUSED(means.commit(), "point 1 has -", "turned inside out");
}

TEST_CASE("the wide stiffness is the derivative of the forces, fading and points alone included") {
  scarp::SerialExecutor executor;
  auto problem = block({.length = 0.6, .stiffness = 0.7, .fading = 2e-4}, {}, executor, 5);
  // Small enough that the configuration's own change, of which the spin counts as local, stays below the tolerance.
  Eigen::VectorXd const start = uneven(problem.dof_count(), 1e-5);
  REQUIRE(problem.evaluate(start).verdict.acceptable());
  problem.commit(start);
  Eigen::VectorXd const at = uneven(problem.dof_count(), 1e-5);
  REQUIRE(problem.evaluate(at).verdict.acceptable());
  scarp::GroundStiffness matrix;
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

TEST_CASE("equations of a wide stiffness are solved as those of its matrix") {
  scarp::SerialExecutor executor;
  auto problem = block({.length = 0.6}, {.reference_strain = 5e-3}, executor);
  Eigen::VectorXd const at = uneven(problem.dof_count(), 2e-3);
  REQUIRE(problem.plan(at).acceptable());
  REQUIRE(problem.evaluate(at).verdict.acceptable());
  scarp::GroundStiffness stiffness;
  problem.ground_stiffness(at, problem.trial_tangents(), stiffness);
  scarp::LinearSystem system(problem.constraints());
  Eigen::Index const size = system.free_count();
  Eigen::MatrixXd matrix(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(problem.dof_count());
    system.scatter(Eigen::VectorXd::Unit(size, column), all);
    matrix.col(column) = system.gather(stiffness * all);
  }
  CHECK((matrix - matrix.transpose()).norm() > 1e-3 * matrix.norm());
  REQUIRE(system.factorize(stiffness).acceptable());
  Eigen::VectorXd const force = uneven(size, 1e3);
  CHECK((system.product(force) - matrix * force).norm() <= 1e-12 * (matrix * force).norm());
  Eigen::VectorXd const exact = matrix.partialPivLu().solve(force);
  // The iteration ends at 1e-4 of the preconditioned residual.
  CHECK((system.solve(force) - exact).norm() <= 1e-3 * exact.norm());
}

TEST_CASE("means and what is solved with them are the same bits on any number of threads") {
  auto const positions = [](auto& executor) {
    samples::Softening const soil{.reference_strain = 0.02};
    auto const local = Local::make(soil, serial());
    auto const& grid = local.discretisation();
    scarp::EquilibriumProblem<Local::Grid> problem(grid, {wide(soil, {.length = 0.5}), sites(grid), volumes(grid)},
                                                   local.constraints(), local.loads(), executor);
    scarp::NoObserver no_observer;
    auto const run = scarp::LoadStepping{.first = 0.005}.run(scarp::QuasiNewton<>{.tolerance = 1e-6}, problem, 0.0,
                                                             0.01, no_observer);
    REQUIRE(run.verdict.acceptable());
    return problem.discretisation().positions();
  };
  scarp::ThreadExecutor three(3);
  CHECK(positions(serial()) == positions(three));
}

TEST_CASE("the work of a problem with a length balances, the stress against fluctuation strain included") {
  scarp::SerialExecutor executor;
  samples::Softening const soil{.reference_strain = 0.02};
  auto const gap = [&](double largest) {
    auto problem = block({.length = 0.5, .fading = 1e-2}, soil, executor);
    scarp::WorkBalance work(problem, 0.0);
    auto const run = scarp::LoadStepping{.first = largest, .largest = largest}.run(
        scarp::QuasiNewton<>{.tolerance = 1e-9}, problem, 0.0, 0.01, work);
    REQUIRE(run.verdict.acceptable());
    return work.gap();
  };
  double const coarse = gap(2e-3);
  CHECK(coarse < 2e-3);
  CHECK(gap(5e-4) < 0.3 * coarse);
}

TEST_CASE("balanced stresses are those of the committed state, whatever was tried since, and a path begins with them") {
  scarp::SerialExecutor executor;
  auto problem = block({.length = 0.5, .stiffness = 0.5}, {.reference_strain = 0.02}, executor);
  auto const moves = uneven(problem.dof_count(), 1e-3);
  REQUIRE(problem.evaluate(moves).verdict.acceptable());
  problem.commit(moves);
  auto const before = problem.balanced_stresses();
  CHECK(before != problem.committed_stresses());
  REQUIRE(problem.evaluate(0.5 * moves).verdict.acceptable());
  CHECK(problem.balanced_stresses() == before);
  auto points = problem.points();
  scarp::PointPath<2> const path(points, scarp::drained_path<2>());
  CHECK(path.stress(0) == before.front());
}

TEST_CASE("the means of a region, of a material whose type is hidden and of points of their own are the same bits") {
  scarp::SerialExecutor executor;
  samples::Softening const soil{.reference_strain = 0.02};
  auto const local = Local::make(soil, executor);
  auto const& grid = local.discretisation();
  scarp::Neighbourhood const around{.length = 0.6, .stiffness = 0.7, .fading = 2e-4};
  auto const answers = [&](scarp::MaterialPoints<2> points) {
    REQUIRE(points.means() != nullptr);
    std::vector<scarp::VoigtStress<2>> stresses;
    for (double const strain : {1e-3, 2e-3}) {
      for (int k = 0; k < points.size(); ++k) {
        points.gradient(k) = scarp::Gradient<2>{{0.1 * strain, 0.0}, {strain, strain * (k % 4)}};
      }
      static_cast<void>(points.respond(executor));
      points.commit();
      auto const balanced = points.balanced_stresses(executor);
      CHECK(balanced == points.stresses());
      CHECK(balanced != points.committed_stresses(executor));
      stresses.insert(stresses.end(), balanced.begin(), balanced.end());
    }
    return stresses;
  };
  auto const expected = answers({wide(soil, around), sites(grid), volumes(grid)});
  scarp::Nonlocal<scarp::AnyProvider<2>> const hidden{soil, around.length, around.stiffness, around.fading};
  CHECK(answers({hidden, sites(grid), volumes(grid)}) == expected);
  scarp::MaterialPoints<2> afterwards(soil, sites(grid));
  afterwards.average(scarp::point_means<2>(sites(grid), volumes(grid), std::vector(sites(grid).size(), around),
                                           afterwards.committed_tangents(executor)));
  CHECK(answers(afterwards) == expected);
  scarp::Region const region{grid.mesh().regions.front(), hidden};
  CHECK(answers(scarp::make_points(grid, 1.0, boost::hana::make_tuple(region), executor)) == expected);
}

TEST_CASE("means stay within the regions that ask for them, and over as many points as there are") {
  scarp::SerialExecutor executor;
  std::vector<scarp::Site<2>> where(8);
  for (int k = 0; k < 8; ++k) {
    where[static_cast<std::size_t>(k)] = {.index = k, .region = k % 2, .position = {0.1 * k, 0.0}};
  }
  std::vector<double> const weights(8, 1.0);
  auto const soil = samples::elastic_soil();
  std::vector<std::string> const names{"wide", "local"};
  auto points = scarp::points_of_regions<2>(
      boost::hana::make_tuple(scarp::Region{names[1], soil}, scarp::Region{names[0], scarp::Nonlocal{soil, 0.25}}),
      names, where, weights, [](int) { return true; });
  for (int k = 0; k < 8; ++k) points.gradient(k)(0, 0) = 1e-4 * k * k;
  static_cast<void>(points.respond(executor));
  for (int k = 0; k < 8; ++k) {
    auto const i = static_cast<std::size_t>(k);
    CHECK((points.gradients()[i] == points.own_gradients()[i]) == (k % 2 == 1));
    CHECK(points.means()->mean().of(k).size() == (k % 2 == 1 ? 1 : k == 0 || k == 6 ? 2 : 3));
  }
  std::vector<scarp::Neighbourhood> const all(7, {.length = 0.25});
  CHECK_REFUSED(points.average(scarp::point_means<2>(std::span(where).first(7), std::span(weights).first(7), all,
                                                     std::vector(7, soil.tangent({})))),
                "means are over 7 points (there are 8)");
  points.average(
      scarp::point_means<2>(where, weights, std::vector<scarp::Neighbourhood>(8), points.committed_tangents(executor)));
  CHECK(points.means() == nullptr);
}

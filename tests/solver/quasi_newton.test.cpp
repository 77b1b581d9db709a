// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/quasi_newton.hpp"

#include <doctest/doctest.h>

#include <map>

#include "bvp/sample_problems.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "support/block.hpp"

namespace {

using scarp::Reason;
using scarp::Status;
using scarp::Verdict;

template <class Solver, class Problem>
scarp::StepReport one_step(Solver const& solver, Problem& problem, double load_increment) {
  typename Solver::template Session<Problem> session(solver, problem);
  scarp::StepReport report;
  REQUIRE(session.begin(0.0, 0.0).acceptable());
  Eigen::VectorXd increment = session.predict(0.0, load_increment);
  session.correct(increment, report);
  if (report.verdict.acceptable()) session.accept(increment);
  return report;
}

Eigen::VectorXd displacements(scarp::Mesh<scarp::Tri3> const& mesh, std::vector<scarp::Vector<2>> const& positions) {
  Eigen::VectorXd all(2 * static_cast<int>(positions.size()));
  for (std::size_t n = 0; n < positions.size(); ++n) {
    all.segment<2>(2 * static_cast<int>(n)) = positions[n] - mesh.nodes[n];
  }
  return all;
}

}  // namespace

TEST_CASE_TEMPLATE("a linear problem is solved by its prediction", Solver, scarp::QuasiNewton<>,
                   scarp::QuasiNewton<samples::Frozen>) {
  using Block = samples::Block<samples::Softening>;
  scarp::SerialExecutor serial;
  auto problem = Block::make({}, serial);
  Solver const solver{.tolerance = 1e-10};
  auto const report = one_step(solver, problem, 0.01);
  CHECK(report.verdict == Verdict{});
  CHECK(report.iterations() == 1);
  // Another path to the same numbers: the direct solution by tests/bvp/sample_problems.hpp. Round-off of two solves.
  auto const& grid = problem.discretisation();
  std::vector<scarp::VoigtStress<2>> const none(static_cast<std::size_t>(grid.point_count()),
                                                scarp::VoigtStress<2>::Zero());
  std::vector<scarp::VoigtTangent<2>> const tangents(none.size(), samples::elastic_soil().tangent({}));
  auto const stiffness = grid.stiffness(Eigen::VectorXd::Zero(grid.dof_count()), none, tangents);
  Eigen::VectorXd const moved = problem.constraints().displacement(0.01);
  Eigen::VectorXd const direct = moved + samples::solve_free(stiffness, problem.constraints(), -(stiffness * moved));
  CHECK((displacements(grid.mesh(), grid.positions()) - direct).norm() < 1e-12 * direct.norm());
}

TEST_CASE("linear elasticity at small strain needs one or two iterations") {
  scarp::SerialExecutor serial;
  auto problem = samples::Block<scarp::LinearElastic<2>>::make(samples::elastic_soil(), serial);
  // The provider's strain measure departs from the linear one by its square: 1e-4 relative at 1e-4, so one correction.
  auto const report = one_step(scarp::QuasiNewton<>{.tolerance = 1e-6}, problem, 1e-4);
  CHECK(report.verdict == Verdict{});
  CHECK(report.iterations() <= 2);
}

TEST_CASE("large strains converge to the same state with every tangent rule") {
  using Block = samples::Block<scarp::LinearElastic<2>, scarp::UpdatedLagrangian>;
  scarp::SerialExecutor serial;
  auto first = Block::make(samples::elastic_soil(), serial);
  auto second = Block::make(samples::elastic_soil(), serial);
  auto third = Block::make(samples::elastic_soil(), serial);
  constexpr double tolerance = 1e-9;
  constexpr int enough = 100;
  using Frozen = scarp::QuasiNewton<samples::Frozen>;
  using Newton = scarp::QuasiNewton<scarp::ConsistentTangent>;
  auto const secant = one_step(scarp::QuasiNewton<>{.tolerance = tolerance, .max_iterations = enough}, first, 0.2);
  auto const frozen = one_step(Frozen{.tolerance = tolerance, .max_iterations = enough}, second, 0.2);
  auto const newton = one_step(Newton{.tolerance = tolerance, .max_iterations = enough}, third, 0.2);
  REQUIRE(secant.verdict == Verdict{});
  REQUIRE(frozen.verdict == Verdict{});
  REQUIRE(newton.verdict == Verdict{});
  CHECK(secant.iterations() > 2);  // the problem is not linear
  // A residual of 1e-9 of the reactions leaves displacements of that order over the block's stiffness: 1e-7 of a metre.
  for (std::size_t n = 0; n < first.discretisation().positions().size(); ++n) {
    auto const& place = first.discretisation().positions()[n];
    CHECK((place - second.discretisation().positions()[n]).norm() < 1e-7);
    CHECK((place - third.discretisation().positions()[n]).norm() < 1e-7);
  }
}

TEST_CASE("materials that say nothing of their tangents are solved by learned ones") {
  using Block = samples::Block<samples::Softening, scarp::UpdatedLagrangian>;
  scarp::SerialExecutor serial;
  auto const pulled = [&](auto const& solver) {
    auto problem = Block::make({.reference_strain = 5e-3}, serial);
    REQUIRE(one_step(solver, problem, 2e-3).verdict == Verdict{});
    return problem.discretisation().positions();
  };
  CHECK(pulled(scarp::QuasiNewton<>{}) == pulled(scarp::QuasiNewton<scarp::PointwiseBroyden>{.tolerance = 5e-3}));
}

TEST_CASE("settling that fails commits nothing and says why") {
  scarp::SerialExecutor serial;
  using Block = samples::Block<samples::Softening>;
  auto problem = Block::make({.largest_strain = -1.0}, serial);
  auto witness = samples::watch(problem);
  auto const run = scarp::LoadStepping{}.settle(scarp::QuasiNewton<>{}, problem, 0.0, witness);
  CHECK(run.verdict == Verdict{Status::failed, Reason::cell_collapsed});
  CHECK(run.refused == 1);
  CHECK(run.worst_point == 0);
  CHECK(witness.reports.size() == 1);
  CHECK(witness.changed_by_refused == 0);
}

TEST_CASE("every point's plan stays what it was at the start of the load step") {
  using Block = samples::Block<samples::Planning>;
  scarp::SerialExecutor serial;
  samples::Planning const soil;
  auto problem = Block::make(soil, serial);
  using Solver = scarp::QuasiNewton<samples::Frozen>;
  Solver const solver{.tolerance = 1e-6};
  for (int step = 0; step < 2; ++step) {
    soil.calls->clear();
    auto const report = one_step(solver, problem, 1e-3 * (step + 1));
    REQUIRE(report.verdict == Verdict{});
    REQUIRE(report.iterations() > 2);
    std::map<int, int> first;
    std::map<int, int> times;
    long work = 0;
    for (auto const& call : *soil.calls) {
      CHECK(first.emplace(call.point, call.plan).first->second == call.plan);
      ++times[call.point];
      work += call.plan;
    }
    CHECK(static_cast<int>(first.size()) == problem.points().size());
    for (auto const& [point, count] : times) CHECK(count == report.iterations());
    long told = 0;
    for (auto const& record : report.history) told += record.inner_steps;
    CHECK(told == work);
  }
}

TEST_CASE("points short of their own accuracy work harder within the step, the others do not") {
  using Block = samples::Block<samples::Planning>;
  scarp::SerialExecutor serial;
  samples::Planning const soil{.needed = 11'000};
  auto problem = Block::make(soil, serial);
  auto const report = one_step(scarp::QuasiNewton<samples::Frozen>{.tolerance = 1e-6}, problem, 1e-3);
  REQUIRE(report.verdict == Verdict{});
  std::map<int, std::vector<int>> plans;
  for (auto const& call : *soil.calls) plans[call.point].push_back(call.plan);
  int refined = 0;
  int left = 0;
  for (auto const& [point, used] : plans) {
    CHECK(used.back() >= soil.needed);
    for (std::size_t k = 1; k < used.size(); ++k) {
      // Either as before or doubled, and doubled only when it was not enough.
      CHECK((used[k] == used[k - 1] || (used[k] == 2 * used[k - 1] && used[k - 1] < soil.needed)));
    }
    (used.back() > used.front() ? refined : left) += 1;
  }
  MESSAGE(refined << " points refined, " << left << " not");
  CHECK(refined > 0);
  CHECK(left > 0);
}

TEST_CASE("points that never converge fail the step with their own reason") {
  using Block = samples::Block<samples::Planning>;
  scarp::SerialExecutor serial;
  auto problem = Block::make({.needed = 2'000'000'000}, serial);
  auto witness = samples::watch(problem);
  scarp::LoadStepping const stepping{.first = 1e-3, .smallest = 1e-4};
  scarp::QuasiNewton<> const solver{.max_iterations = 4, .max_refinements = 2};
  auto const run = stepping.run(solver, problem, 0.0, 1e-3, witness);
  CHECK(run.verdict == Verdict{Status::not_converged, Reason::step_too_small});
  CHECK(run.last_failure == Reason::unbalanced);
  CHECK(run.worst_point >= 0);
  CHECK(run.steps == 0);
  CHECK(witness.changed_by_refused == 0);
}

namespace {

/// A smooth wall that holds nodes from moving further to the right.
struct Wall {
  double place;      // [m]
  double stiffness;  // of a node's contact [N/m]
  std::vector<int> nodes;
  std::vector<bool> touched{};

  static int extra_dofs() { return 0; }
  scarp::Verdict add_forces(std::vector<scarp::Vector<2>> const& places, Eigen::VectorXd const& increment,
                            Eigen::VectorXd& forces) {
    touched.clear();
    for (int const node : nodes) {
      double const depth = places[static_cast<std::size_t>(node)].x() + increment(2 * node) - place;
      touched.push_back(depth > 0.0);
      if (depth > 0.0) forces(2 * node) += stiffness * depth;
    }
    return {};
  }
  void add_stiffness(std::vector<Eigen::Triplet<double>>& entries) const {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (touched[k]) entries.emplace_back(2 * nodes[k], 2 * nodes[k], stiffness);
    }
  }
  void commit(std::vector<scarp::Vector<2>> const&, Eigen::VectorXd const&) {}
  SCARP_MEMBERS_EXCEPT((place, stiffness, nodes, touched))
};
static_assert(scarp::Attachment<Wall, 2>);

}  // namespace

TEST_CASE("contact is followed within the linear system: material that is linear is asked once for a step") {
  scarp::SerialExecutor serial;
  auto const bare = samples::Block<samples::Softening>::make({}, serial);
  auto const& grid = bare.discretisation();
  Wall const wall{.place = 1e-4, .stiffness = 1e9, .nodes = scarp::boundary_nodes(grid.mesh(), "left")};
  scarp::EquilibriumProblem<samples::Block<samples::Softening>::Grid> problem(grid, bare.points(), bare.constraints(),
                                                                              bare.loads(), serial, wall);
  scarp::NoObserver no_observer;
  // The block is stretched: its left side comes inwards and meets the wall.
  scarp::QuasiNewton<> const newton{.tolerance = 1e-9, .repeats_motion = false};
  auto const run = scarp::LoadStepping{.first = 2e-4, .largest = 2e-4}.run(newton, problem, 0.0, 2e-3, no_observer);
  REQUIRE(run.verdict.acceptable());
  CHECK(run.iterations == run.steps);
  int touching = 0;
  for (bool const touches : problem.attached<Wall>().touched) touching += touches ? 1 : 0;
  CHECK(touching > 0);
}

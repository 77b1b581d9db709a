// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/linear_solver.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <functional>
#include <memory>
#include <stdexcept>

#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/core/interruption.hpp"
#include "scarp/core/random.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/linear_system.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/approx.hpp"
#include "support/crossed_rectangle.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Reason;
using scarp::SparseMatrix;

/// Well conditioned, a third filled; symmetric positive definite or neither.
SparseMatrix random_matrix(int size, std::uint64_t seed, bool symmetric) {
  scarp::Random random(seed);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  for (auto& entry : dense.reshaped()) {
    double const value = random.uniform(-1.0, 1.0);
    entry = random.uniform() < 0.3 ? value : 0.0;
  }
  if (symmetric) dense = (dense + dense.transpose()).eval();
  dense.diagonal().array() += size;
  return dense.sparseView();
}

/// A linear solver of a user's: dense factors.
struct DenseLu : scarp::LinearSolver {
  Eigen::PartialPivLU<Eigen::MatrixXd> factors;
  int* calls;

  explicit DenseLu(int& counted) : calls(&counted) {}
  scarp::Verdict factorize(SparseMatrix const& matrix) override {
    ++*calls;
    factors.compute(Eigen::MatrixXd(matrix));
    return {};
  }
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const override { return factors.solve(right); }
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const override {
    return factors.transpose().solve(right);
  }
};

auto const cholesky = scarp::direct_solver<Eigen::SimplicialLDLT<SparseMatrix>>;

/// Equations of free degrees of freedom alone.
scarp::LinearSystem free_system(SparseMatrix const& matrix, scarp::Verdict const& expected = {}) {
  scarp::Mesh<scarp::Tri3> mesh;
  mesh.nodes.resize(static_cast<std::size_t>(matrix.rows()) / 2);
  scarp::LinearSystem system{scarp::Constraints(mesh)};
  CHECK(system.factorize({matrix}) == expected);
  return system;
}

void solves(scarp::LinearSolver& solver, SparseMatrix const& matrix) {
  Eigen::VectorXd const right = Eigen::VectorXd::LinSpaced(matrix.rows(), -1.0, 2.0);
  REQUIRE(solver.factorize(matrix).acceptable());
  // Round-off of a direct solver on a well-conditioned system.
  CHECK((matrix * solver.solve(right) - right).norm() < 1e-13 * right.norm());
  CHECK((matrix.transpose() * solver.solve_transposed(right) - right).norm() < 1e-13 * right.norm());
}

using Grid = scarp::Discretisation<scarp::Tri3, scarp::SmallStrain>;
using Soil = scarp::LinearElastic<2>;

/// A block of two regions side by side that do not share nodes; only the left one is held.
Grid two_blocks() {
  auto mesh = samples::CrossedRectangle{.width = 1.0, .height = 1.0, .columns = 3, .rows = 3}.generate();
  int const offset = static_cast<int>(mesh.nodes.size());
  auto const single = mesh;
  mesh.regions = {"held", "adrift"};
  for (auto const& node : single.nodes) mesh.nodes.emplace_back(node + scarp::Vector<2>(2.0, 0.0));
  for (auto element : single.elements) {
    for (int& node : element) node += offset;
    mesh.elements.push_back(element);
    mesh.element_region.push_back(1);
  }
  return Grid(mesh);
}

}  // namespace

TEST_CASE("linear solvers solve one system after the other") {
  auto const lu = scarp::sparse_lu();
  auto const ldlt = cholesky();
  for (int const size : {5, 40, 40, 17}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      solves(*lu, random_matrix(size, seed, true));
      solves(*lu, random_matrix(size, seed, false));
      solves(*ldlt, random_matrix(size, seed, true));
    }
  }
}

TEST_CASE("the ordering of one pattern does not spoil another one with as many entries") {
  // An arrow that points down and one that points up: same size, same number of entries.
  constexpr int size = 30;
  for (auto const& solver : {scarp::sparse_lu(), cholesky()}) {
    for (int const tip : {0, size - 1, 0}) {
      Eigen::MatrixXd arrow = Eigen::MatrixXd::Identity(size, size) * size;
      arrow.row(tip).setOnes();
      arrow.col(tip).setOnes();
      arrow(tip, tip) = 2.0 * size;
      solves(*solver, arrow.sparseView());
    }
  }
}

TEST_CASE("a linear solver says that a singular or not finite matrix cannot be solved") {
  SparseMatrix matrix = random_matrix(20, 5, true);
  auto const solver = scarp::sparse_lu();
  for (double const bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    matrix.coeffRef(3, 3) = bad;
    CHECK(solver->factorize(matrix).reason == Reason::not_finite);
  }
  Eigen::MatrixXd dense = random_matrix(20, 5, true);
  dense.row(7).setZero();
  dense.col(7).setZero();
  scarp::Verdict const singular{scarp::Status::failed, Reason::singular_system};
  CHECK(solver->factorize(dense.sparseView()) == singular);
  CHECK(solver->factorize(random_matrix(20, 5, true)).acceptable());
  CHECK(free_system(dense.sparseView(), singular).weakest_dof() == 7);
  SparseMatrix nothing(20, 20);
  CHECK(free_system(nothing, singular).weakest_dof() >= 0);  // without an entry, and then with entries of zero
  nothing.setIdentity();
  CHECK(free_system(0.0 * nothing, singular).weakest_dof() >= 0);
}

TEST_CASE("a check of the caller ends work before each factorisation; the former factors stay") {
  SparseMatrix const matrix = random_matrix(8, 5, false);
  auto system = free_system(matrix);
  Eigen::VectorXd const right = Eigen::VectorXd::LinSpaced(8, -1.0, 2.0);
  Eigen::VectorXd const before = system.solve(right);
  std::function<void()> const check = [] { throw std::length_error("enough"); };
  {
    scarp::InterruptionCheck const checked(&check);
    CHECK_THROWS_AS(static_cast<void>(system.factorize({2.0 * matrix})), std::length_error);
    CHECK_THROWS_AS(static_cast<void>(system.weakest_dof()), std::length_error);
  }
  CHECK(system.solve(right) == before);
}

TEST_CASE("the free part of a system is the full one without prescribed rows and columns") {
  auto const mesh = samples::CrossedRectangle{.columns = 2, .rows = 1}.generate();
  scarp::Constraints constraints(mesh);
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) constraints.fix(node);
  constraints.move(3, 1, -2.0);
  scarp::LinearSystem system(constraints);
  auto const full = random_matrix(constraints.dof_count(), 7, false);
  auto const free = constraints.free_dofs();
  Eigen::MatrixXd const dense = full;
  REQUIRE(system.factorize({full}).acceptable());
  Eigen::MatrixXd const part = system.matrix();
  REQUIRE(part.rows() == static_cast<Eigen::Index>(free.size()));
  CHECK(part == dense(free, free));

  Eigen::VectorXd const vector = Eigen::VectorXd::LinSpaced(constraints.dof_count(), -1.0, 2.0);
  CHECK(system.gather(vector) == vector(free));
  Eigen::VectorXd scattered = constraints.displacement(0.5);
  system.scatter(system.gather(vector), scattered);
  CHECK(scattered(2 * 3 + 1) == -1.0);  // analytic: rate times load
  for (int const dof : free) CHECK(scattered(dof) == vector(dof));
}

namespace {

/// As far as an iteration comes that finds a share of the solution.
template <int percent>
Eigen::VectorXd partly(scarp::LinearMap const&, scarp::LinearMap const& inverse, Eigen::VectorXd const& right) {
  return percent / 100.0 * inverse(right);
}

/// Elements of unit stiffness without strains: means over neighbours add a second part of zero.
using Elements = Grid;
struct UnitGrid : Elements {
  using Elements::Elements;
  void stiffness(Eigen::VectorXd const&, std::span<scarp::VoigtStress<2> const>,
                 std::span<scarp::VoigtTangent<2> const>, SparseMatrix& out) const override {
    out.resize(dof_count(), dof_count());
    out.setIdentity();
  }
  SparseMatrix strain_operator(Eigen::VectorXd const&) const override { return {3 * point_count(), dof_count()}; }
};

}  // namespace

TEST_CASE("an iteration that stagnates far from the solution is no solution") {
  auto const mesh = samples::CrossedRectangle{.columns = 2, .rows = 1}.generate();
  scarp::Constraints constraints(mesh);
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) constraints.fix(node);
  Eigen::VectorXd const still = Eigen::VectorXd::Zero(constraints.dof_count());
  Eigen::VectorXd const unbalanced = Eigen::VectorXd::Constant(constraints.dof_count(), 2.0);
  Grid const grid(mesh);
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  std::vector const tangents(sites.size(), scarp::VoigtTangent<2>(scarp::VoigtTangent<2>::Identity()));
  auto const soil = Soil::from_young_poisson(20e6, 0.3);
  std::vector<std::size_t> first{0};
  std::vector<scarp::NeighbourMean::Share> shares;  // all see all
  for (int point = 0; point < grid.point_count(); ++point) {
    for (auto const& site : sites) shares.push_back({site.index, 1.0 / static_cast<double>(sites.size())});
    first.push_back(shares.size());
  }
  scarp::NeighbourMean const mean(first, shares);
  std::vector const hoods(sites.size(), scarp::Neighbourhood{.length = 1.0});
  scarp::SerialExecutor serial;
  for (auto const& [iterate, verdict] :
       {std::pair{&partly<95>, scarp::Verdict{}},
        std::pair{&partly<80>, scarp::Verdict{scarp::Status::not_converged, Reason::iterations_spent}},
        std::pair{&partly<-5>, scarp::Verdict{scarp::Status::failed, Reason::singular_system}}}) {
    scarp::MaterialPoints<2> points(soil, sites);
    points.average(std::make_unique<scarp::NonlocalMeans<2>>(mean, hoods, tangents, iterate));
    scarp::Problem<2> problem(std::make_unique<UnitGrid>(mesh), std::move(points), constraints, still, serial);
    scarp::LinearisedStep<2> step(problem, 1e-3);
    REQUIRE(step.linearise(still, unbalanced, tangents).acceptable());
    Eigen::VectorXd increment = still;
    CHECK(step.solve(increment, still) == verdict);
    CHECK(step.system().residual() == samples::Approx(1.0 - iterate(
                                                                {}, [](auto const& x) { return x; }, unbalanced)(0) /
                                                                2.0));
    if (!verdict.acceptable()) CHECK(increment == still);
  }
}

TEST_CASE("the estimate of the condition number is close below the true one") {
  scarp::Random random(1);
  for (int draw = 0; draw < 50; ++draw) {
    Eigen::MatrixXd dense = random_matrix(30, static_cast<std::uint64_t>(draw), false);
    dense.row(static_cast<int>(random.uniform(0.0, 30.0))) *= std::pow(10.0, random.uniform(-8.0, 8.0));
    SparseMatrix const matrix = dense.sparseView();
    auto const norm = [](Eigen::MatrixXd const& a) { return a.cwiseAbs().colwise().sum().maxCoeff(); };
    double const exact = norm(dense) * norm(dense.inverse());
    double const estimate = free_system(matrix).condition();
    CHECK(estimate <= exact * (1.0 + 1e-6));
    CHECK(estimate >= exact / 3.0);
  }
}

TEST_CASE("a problem is solved by the linear solver that its settings name") {
  auto const mesh = samples::CrossedRectangle{.columns = 2, .rows = 2}.generate();
  scarp::Constraints constraints(mesh);
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) constraints.fix(node);
  for (int const node : scarp::boundary_nodes(mesh, "top")) constraints.move(node, 1, -1e-3);
  Grid const grid(mesh);
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  scarp::SerialExecutor serial;
  scarp::NoObserver no_observer;
  auto const solved = [&](scarp::QuasiNewton<> const& newton) {
    scarp::EquilibriumProblem<Grid> problem(grid, {Soil::from_young_poisson(20e6, 0.3), sites}, constraints, {},
                                            serial);
    CHECK(scarp::LoadStepping{.first = 1.0}.run(newton, problem, 0.0, 1.0, no_observer).verdict == scarp::Verdict{});
    return problem.discretisation().positions();
  };
  int calls = 0;
  auto const expected = solved({});
  auto const dense = solved({.linear_solver = [&] { return std::make_unique<DenseLu>(calls); }});
  auto const symmetric = solved({.linear_solver = cholesky});
  CHECK(calls > 0);
  for (std::size_t node = 0; node < expected.size(); ++node) {  // round-off of the solves, of 1 mm
    CHECK((dense[node] - expected[node]).norm() < 1e-14);
    CHECK((symmetric[node] - expected[node]).norm() < 1e-14);
  }
  CHECK_REFUSED(scarp::QuasiNewton<>{.linear_solver = {}}.validate(), "linear solver of an iteration", "is empty");
}

TEST_CASE("a body that nothing holds is found out: a singular system, and which node of which region drifts") {
  auto const grid = two_blocks();
  scarp::Constraints constraints(grid.mesh());
  for (int n = 0; n < 4; ++n) constraints.fix(n);  // the left block's bottom row
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  Eigen::VectorXd const load = Eigen::VectorXd::Ones(grid.dof_count());
  scarp::SerialExecutor executor;
  scarp::EquilibriumProblem<Grid> problem(grid, {Soil::from_young_poisson(20e6, 0.3), sites}, constraints, load,
                                          executor);
  scarp::NoObserver no_observer;
  auto const run = scarp::LoadStepping{.first = 1.0}.run(scarp::QuasiNewton<>{}, problem, 0.0, 1.0, no_observer);
  CHECK(run.verdict.reason == Reason::singular_system);
  REQUIRE(run.weak_dof >= 0);
  auto const words = describe_dof(grid, run.weak_dof);
  CHECK(words.find("region adrift") != std::string::npos);
  CHECK(words.find("node ") != std::string::npos);
}

// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <limits>

#include "scarp/core/random.hpp"
#include "scarp/mesh/rectangle_mesh.hpp"
#include "scarp/solver/free_system.hpp"
#include "scarp/solver/sparse_lu.hpp"

namespace {

using scarp::Reason;
using scarp::Status;
using scarp::Verdict;

/// Unsymmetric, about a third filled, dominant on the diagonal.
Eigen::SparseMatrix<double> random_matrix(int size, std::uint64_t seed) {
  scarp::Random random(seed);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  for (auto& entry : dense.reshaped()) {
    double const value = random.uniform(-1.0, 1.0);
    entry = random.uniform() < 0.3 ? value : 0.0;
  }
  dense.diagonal().array() += 5.0;
  return dense.sparseView();
}

Eigen::VectorXd ramp(Eigen::Index size) { return Eigen::VectorXd::LinSpaced(size, -1.0, 2.0); }

// Round-off of two direct solvers on well-conditioned systems of some tens of unknowns.
constexpr double round_off = 1e-13;

}  // namespace

TEST_CASE("the free part of a system is the full one without prescribed rows and columns") {
  auto const mesh = scarp::RectangleMesh{.columns = 2, .rows = 1}.generate();
  scarp::Constraints constraints(mesh);
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) constraints.fix(node);
  constraints.move(3, 1, -2.0);
  scarp::FreeSystem const system(constraints);
  auto const full = random_matrix(constraints.dof_count(), 7);
  auto const free = constraints.free_dofs();
  Eigen::MatrixXd const dense = full;
  Eigen::MatrixXd const part = system.matrix(full);
  REQUIRE(part.rows() == static_cast<Eigen::Index>(free.size()));
  CHECK(part == dense(free, free));

  Eigen::VectorXd const vector = ramp(constraints.dof_count());
  CHECK(system.gather(vector) == vector(free));
  Eigen::VectorXd scattered = constraints.displacement(0.5);
  system.scatter(system.gather(vector), scattered);
  CHECK(scattered(2 * 3 + 1) == -1.0);  // analytic: rate times load
  for (int const dof : free) CHECK(scattered(dof) == vector(dof));
}

TEST_CASE("sparse and dense factorisation solve the same unsymmetric system") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    auto const matrix = random_matrix(40, seed);
    Eigen::VectorXd const right = ramp(40);
    scarp::SparseLu solver;
    REQUIRE(solver.factorize(matrix) == Verdict{});
    Eigen::VectorXd const dense = Eigen::MatrixXd(matrix).partialPivLu().solve(right);
    CHECK((solver.solve(right) - dense).norm() < round_off * dense.norm());
  }
}

TEST_CASE("a solver takes one matrix after the other, of any size and pattern") {
  scarp::SparseLu solver;
  for (int const size : {30, 30, 12, 45, 30}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      auto const matrix = random_matrix(size, seed);
      REQUIRE(solver.factorize(matrix).acceptable());
      CHECK((matrix * solver.solve(ramp(size)) - ramp(size)).norm() < round_off * ramp(size).norm());
    }
  }
}

TEST_CASE("the ordering of one pattern does not spoil another one with as many entries") {
  // An arrow that points down and one that points up: same size, same number of entries.
  constexpr int size = 30;
  scarp::SparseLu solver;
  for (int const tip : {0, size - 1, 0}) {
    Eigen::MatrixXd arrow = Eigen::MatrixXd::Identity(size, size) * size;
    arrow.row(tip).setOnes();
    arrow.col(tip).setOnes();
    arrow(tip, tip) = 2.0 * size;
    Eigen::SparseMatrix<double> const matrix = arrow.sparseView();
    REQUIRE(solver.factorize(matrix).acceptable());
    CHECK((matrix * solver.solve(ramp(size)) - ramp(size)).norm() < round_off * ramp(size).norm());
  }
}

TEST_CASE("a singular system and one that is not finite are named") {
  auto matrix = random_matrix(10, 3);
  scarp::SparseLu solver;
  REQUIRE(solver.factorize(matrix).acceptable());
  auto singular = matrix;
  for (Eigen::SparseMatrix<double>::InnerIterator entry(singular, 4); entry; ++entry) entry.valueRef() = 0.0;
  CHECK(solver.factorize(singular) == Verdict{Status::failed, Reason::singular_system});
  for (double const bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto broken = matrix;
    broken.coeffs()(5) = bad;
    CHECK(solver.factorize(broken) == Verdict{Status::failed, Reason::not_finite});
  }
  // A refused matrix leaves nothing behind.
  REQUIRE(solver.factorize(matrix).acceptable());
  CHECK((matrix * solver.solve(ramp(10)) - ramp(10)).norm() < round_off * ramp(10).norm());
}

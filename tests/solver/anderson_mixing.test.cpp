// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/anderson_mixing.hpp"

#include <doctest/doctest.h>

#include "scarp/core/random.hpp"
#include "scarp/solver/plain_step.hpp"

namespace {

/// Fixed point of x <- x + d(x), d(x) = b - A x.
struct Linear {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;

  explicit Linear(int size) : matrix(size, size), right(size) {
    scarp::Random random(11);
    for (auto& entry : matrix.reshaped()) entry = random.uniform(-0.3, 0.3);
    matrix.diagonal().array() += 1.0;
    for (auto& entry : right) entry = random.uniform(-1.0, 1.0);
  }

  Eigen::VectorXd correction(Eigen::VectorXd const& x) const { return right - matrix * x; }
  double error(Eigen::VectorXd const& x) const { return correction(x).norm() / right.norm(); }
};

scarp::AndersonMixing of_depth(int depth) {
  scarp::AndersonMixing mixing;
  mixing.depth = depth;
  return mixing;
}

template <class Mixing>
Eigen::VectorXd iterate(Mixing& mixing, Linear const& problem, Eigen::VectorXd x, int times) {
  for (int k = 0; k < times; ++k) x = mixing.next(x, problem.correction(x));
  return x;
}

}  // namespace

TEST_CASE("a linear problem of n unknowns is solved by n + 1 mixes") {
  // Analytic: equivalent to GMRES (Walker and Ni 2011, theorem 2.2), which ends after n steps; the last mix is the step to
  // that point. Round-off is amplified by the conditioning of the differences.
  for (int const size : {1, 2, 3, 5}) {
    Linear const problem(size);
    auto mixing = of_depth(size);
    CHECK(problem.error(iterate(mixing, problem, Eigen::VectorXd::Zero(size), size + 1)) < 1e-10);
    scarp::PlainStep plain;
    if (size > 1) CHECK(problem.error(iterate(plain, problem, Eigen::VectorXd::Zero(size), size + 1)) > 1e-6);
  }
}

TEST_CASE("the first mix is the plain step, also after forgetting") {
  Linear const problem(4);
  Eigen::VectorXd const start = Eigen::VectorXd::Ones(4);
  scarp::PlainStep plain;
  scarp::AndersonMixing mixing;
  Eigen::VectorXd const first = mixing.next(start, problem.correction(start));
  CHECK(first == plain.next(start, problem.correction(start)));
  iterate(mixing, problem, first, 3);
  CHECK(mixing.next(start, problem.correction(start)) != first);
  mixing.forget();
  CHECK(mixing.next(start, problem.correction(start)) == first);
}

TEST_CASE("with depth zero mixing is the plain step") {
  Linear const problem(4);
  auto mixing = of_depth(0);
  scarp::PlainStep plain;
  Eigen::VectorXd const start = Eigen::VectorXd::Ones(4);
  CHECK(iterate(mixing, problem, start, 5) == iterate(plain, problem, start, 5));
}

TEST_CASE("directions that repeat themselves are harmless") {
  Linear const problem(3);
  auto mixing = of_depth(8);  // deeper than there are directions
  CHECK(problem.error(iterate(mixing, problem, Eigen::VectorXd::Zero(3), 20)) < 1e-10);
  // The very same point again and again: no differences at all.
  Eigen::VectorXd const still = Eigen::VectorXd::Ones(3);
  Eigen::VectorXd const correction = problem.correction(still);
  mixing.forget();
  for (int k = 0; k < 5; ++k) CHECK(mixing.next(still, correction) == still + correction);
}

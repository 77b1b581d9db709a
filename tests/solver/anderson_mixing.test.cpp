// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/anderson_mixing.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <array>

#include "scarp/core/random.hpp"

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

using Mixing = scarp::AndersonMixing<Eigen::VectorXd>;

Eigen::VectorXd iterate(Mixing& mixing, Linear const& problem, Eigen::VectorXd x, int times) {
  for (int k = 0; k < times; ++k) x = mixing.next(x, problem.correction(x));
  return x;
}

Eigen::VectorXd plain(Linear const& problem, Eigen::VectorXd x, int times) {
  for (int k = 0; k < times; ++k) x = x + problem.correction(x);
  return x;
}

/// A vector that is shared out among two processes, with no operator and no member of Eigen's.
struct InTwoParts {
  std::array<std::vector<double>, 2> parts;
};

struct OverBothParts {
  double dot(InTwoParts const& first, InTwoParts const& second) const {
    double sum = 0.0;
    for (std::size_t part = 0; part < 2; ++part)
      for (std::size_t k = 0; k < first.parts[part].size(); ++k) sum += first.parts[part][k] * second.parts[part][k];
    return sum;
  }
  void add(double factor, InTwoParts const& vector, InTwoParts& to) const {
    for (std::size_t part = 0; part < 2; ++part)
      for (std::size_t k = 0; k < to.parts[part].size(); ++k) to.parts[part][k] += factor * vector.parts[part][k];
  }
};

InTwoParts shared_out(Eigen::VectorXd const& vector, Eigen::Index first_part) {
  return {{std::vector<double>(vector.begin(), vector.begin() + first_part),
           std::vector<double>(vector.begin() + first_part, vector.end())}};
}

Eigen::VectorXd gathered(InTwoParts const& vector) {
  std::vector<double> all = vector.parts[0];
  all.insert(all.end(), vector.parts[1].begin(), vector.parts[1].end());
  return Eigen::VectorXd::Map(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace

TEST_CASE("a linear problem of n unknowns is solved by n + 1 mixes") {
  // Analytic: equivalent to GMRES (Walker and Ni 2011, theorem 2.2), which ends after n steps; the last mix is the step
  // to that point. Round-off is amplified by the conditioning of the differences.
  for (int const size : {1, 2, 3, 5}) {
    Linear const problem(size);
    Mixing mixing(size);
    CHECK(problem.error(iterate(mixing, problem, Eigen::VectorXd::Zero(size), size + 1)) < 1e-10);
    if (size > 1) CHECK(problem.error(plain(problem, Eigen::VectorXd::Zero(size), size + 1)) > 1e-6);
  }
}

TEST_CASE("the first mix is the plain step, also after forgetting") {
  Linear const problem(4);
  Eigen::VectorXd const start = Eigen::VectorXd::Ones(4);
  Mixing mixing;
  Eigen::VectorXd const first = mixing.next(start, problem.correction(start));
  CHECK(first == plain(problem, start, 1));
  iterate(mixing, problem, first, 3);
  CHECK(mixing.next(start, problem.correction(start)) != first);
  mixing.forget();
  CHECK(mixing.next(start, problem.correction(start)) == first);
}

TEST_CASE("with depth zero mixing is the plain step and a negative depth is refused") {
  Linear const problem(4);
  Mixing mixing(0);
  Eigen::VectorXd const start = Eigen::VectorXd::Ones(4);
  CHECK(iterate(mixing, problem, start, 5) == plain(problem, start, 5));
  CHECK_THROWS_WITH_AS(Mixing(-1), doctest::Contains("depth of Anderson's mixing is -1"), scarp::InputError);
}

TEST_CASE("directions that repeat themselves are harmless") {
  Linear const problem(3);
  Mixing mixing(8);  // deeper than there are directions
  CHECK(problem.error(iterate(mixing, problem, Eigen::VectorXd::Zero(3), 20)) < 1e-10);
  // The very same point again and again: no differences at all.
  Eigen::VectorXd const still = Eigen::VectorXd::Ones(3);
  Eigen::VectorXd const correction = problem.correction(still);
  mixing.forget();
  for (int k = 0; k < 5; ++k) CHECK(mixing.next(still, correction) == still + correction);
}

TEST_CASE("vectors that are shared out among processes are mixed by the dot product over all of them") {
  constexpr int size = 6;
  Linear const problem(size);
  scarp::AndersonMixing<InTwoParts, OverBothParts> mixing(size);
  InTwoParts x = shared_out(Eigen::VectorXd::Zero(size), 2);
  for (int k = 0; k <= size; ++k) x = mixing.next(x, shared_out(problem.correction(gathered(x)), 2));
  // Analytic, as above: the product over one part alone would not find the fixed point.
  CHECK(problem.error(gathered(x)) < 1e-10);
}

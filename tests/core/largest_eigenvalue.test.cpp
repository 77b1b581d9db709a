// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/largest_eigenvalue.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "support/approx.hpp"

TEST_CASE("the stiffest mode of a chain of springs between walls is found to the tolerance asked for") {
  constexpr std::size_t masses = 50;
  auto const chain = [](std::vector<double> const& x, std::vector<double>& y) {
    for (std::size_t i = 0; i < masses; ++i) {
      y[i] = 2.0 * x[i] - (i > 0 ? x[i - 1] : 0.0) - (i + 1 < masses ? x[i + 1] : 0.0);
    }
  };
  // Analytic: 4 sin^2(n pi / 2 (n + 1)) for n masses.
  double const root = std::sin(masses * std::numbers::pi / (2.0 * (masses + 1.0)));
  double const exact = 4.0 * root * root;
  double const rough = scarp::largest_eigenvalue(masses, chain, 1e-2);
  CHECK(rough == samples::Approx(exact).epsilon(1e-2));
  CHECK(rough <= exact * (1.0 + 1e-14));
  CHECK(scarp::largest_eigenvalue(masses, chain, 1e-13) == samples::Approx(exact).epsilon(1e-12));
}

TEST_CASE("few different eigenvalues use up the search, and a zero matrix has none above zero") {
  auto const two = [](std::vector<double> const& x, std::vector<double>& y) {
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = (i % 2 == 0 ? 3.0 : 7.0) * x[i];
  };
  CHECK(scarp::largest_eigenvalue(9, two, 1e-3) == samples::Approx(7.0).epsilon(1e-12));
  CHECK(scarp::largest_eigenvalue(
            9, [](auto const&, auto&) {}, 1e-3) == 0.0);
}

TEST_CASE("a matrix with an entry that is no number has no largest eigenvalue") {
  auto const broken = [](std::vector<double> const& x, std::vector<double>& y) {
    y = x;
    y[3] *= std::nan("");
  };
  CHECK(std::isnan(scarp::largest_eigenvalue(9, broken, 1e-3)));
}

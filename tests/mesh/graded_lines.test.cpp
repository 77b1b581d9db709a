// SPDX-License-Identifier: BSL-1.0
#include "scarp/mesh/graded_lines.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "support/approx.hpp"
#include "support/refusals.hpp"

TEST_CASE("an even spacing gives even lines") {
  auto const lines = scarp::graded_lines(scarp::Spacing({{0.0, 0.5}, {2.0, 0.5}}), {0.0, 2.0});
  CHECK(lines == std::vector<double>{0.0, 0.5, 1.0, 1.5, 2.0});  // analytic, exact in binary
}

TEST_CASE("a linear spacing gives cells that grow by a constant ratio") {
  scarp::Spacing const spacing({{1.0, 0.2}, {5.0, 1.0}});
  auto const lines = scarp::graded_lines(spacing, {1.0, 5.0});
  // Analytic: integral dx/s = ln(5)/0.2 = 8.05 cells, so 8; equal steps of ln(s) give the ratio 5^(1/8).
  REQUIRE(lines.size() == 9);
  for (std::size_t k = 2; k < lines.size(); ++k) {
    CHECK((lines[k] - lines[k - 1]) / (lines[k - 1] - lines[k - 2]) ==
          samples::Approx(std::pow(5.0, 1.0 / 8.0)).epsilon(1e-12));  // round-off of logarithm and exponential
  }
  CHECK(lines.back() == 5.0);
}

TEST_CASE("counting cells and walking them are inverse to each other across the knots") {
  scarp::Spacing const spacing({{-3.0, 1.0}, {0.0, 0.25}, {2.0, 0.25}, {9.0, 2.0}});
  for (double const x : {-3.0, -1.7, 0.0, 0.4, 2.0, 2.1, 8.9, 9.0}) {
    CHECK(std::abs(spacing.position_after(spacing.cells_to(x)) - x) < 1e-13);  // round-off at |x| < 10
  }
}

TEST_CASE("beyond the last knot the spacing goes on as before it") {
  scarp::Spacing const spacing({{0.0, 1.0}, {2.0, 0.5}, {4.0, 0.5}});
  CHECK(spacing.position_after(spacing.cells_to(4.0) + 2.0) == samples::Approx(5.0));
  CHECK(spacing.cells_to(5.0) == samples::Approx(spacing.cells_to(4.0) + 2.0));
}

TEST_CASE("every fixed line is met exactly, however short the way to the next") {
  auto const lines = scarp::graded_lines(scarp::Spacing({{0.0, 1.0}, {10.0, 1.0}}), {0.0, 0.1, 1.0 / 3.0, 10.0});
  for (double const fixed : {0.0, 0.1, 1.0 / 3.0, 10.0}) {
    CHECK(std::find(lines.begin(), lines.end(), fixed) != lines.end());
  }
  CHECK(std::is_sorted(lines.begin(), lines.end()));
}

TEST_CASE("a least number of cells is kept") {
  CHECK(scarp::graded_lines(scarp::Spacing({{0.0, 5.0}, {1.0, 5.0}}), {0.0, 1.0}, 2).size() == 3);
}

TEST_CASE("spacings and lines that cannot be are refused") {
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  CHECK_REFUSED(scarp::Spacing({{0.0, 5.0}}), "has 1 knots");
  CHECK_REFUSED(scarp::Spacing({{0.0, 5.0}, {0.0, 5.0}}), "positions must increase");
  CHECK_REFUSED(scarp::Spacing({{0.0, 5.0}, {1.0, 0.0}}), "size at a knot of a spacing is 0");
  CHECK_REFUSED(scarp::Spacing({{not_a_number, 5.0}, {1.0, 5.0}}), "position of a knot");
  scarp::Spacing const spacing({{0.0, 0.1}, {1.0, 1.0}});
  CHECK_REFUSED(scarp::graded_lines(scarp::Spacing({{0.0, 1e-9}, {1.0, 1e-9}}), {0.0, 4.3}), "4.3e+09 cells");
  CHECK_REFUSED(scarp::graded_lines(spacing, {}), "0 positions");
  CHECK_REFUSED(scarp::graded_lines(spacing, {0.0, 0.0}), "positions must increase");
  CHECK_REFUSED(scarp::graded_lines(spacing, {-0.2, 1.0}), "within the knots");  // the size falls to zero at -0.11
}

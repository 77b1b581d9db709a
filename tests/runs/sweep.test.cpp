// SPDX-License-Identifier: BSL-1.0
#include "../../benchmarks/error_vs_time/sweep.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using error_vs_time::Measured;

struct Settings {
  double size = 0.25;
  int sides = 4;
};

/// Trapezoidal rule for the integral of exp over [0, 1]: error (e - 1) h^2 / 12 + O(h^4).
double trapezoids(double size) {
  int const count = static_cast<int>(std::lround(1.0 / size));
  double sum = 0.5 * (1.0 + std::exp(1.0));
  for (int k = 1; k < count; ++k) sum += std::exp(k * size);
  return sum * size;
}

Measured integral(Settings const& settings) {
  Measured measured{.inner_steps = std::lround(1.0 / settings.size)};
  measured.add("integral", trapezoids(settings.size));
  return measured;
}

Measured exact_integral() {
  Measured exact;
  exact.add("integral", std::exp(1.0) - 1.0);
  return exact;
}

struct Rectangles {
  static double sum(double size) { return trapezoids(size) - 0.5 * size * (std::exp(1.0) - 1.0); }
};
struct Trapezoids {
  static double sum(double size) { return trapezoids(size); }
};

}  // namespace

TEST_CASE("a sweep of the trapezoidal rule finds its second order and its exact errors") {
  error_vs_time::Sweep sweep("trapezoids", Settings{}, integral);
  sweep.min_seconds = 0.0;
  sweep.exact(exact_integral());
  sweep.vary("size", &Settings::size, {0.25, 0.125, 0.0625, 0.03125});
  auto const table = sweep.run();
  REQUIRE(table.rows.size() == 5);
  CHECK(table.rows[1].inner_steps == 4.0);
  // Analytic: h^2 / 12 of the integral itself, up to a share h^2 / 60 (Euler and Maclaurin).
  for (int k = 1; k <= 4; ++k) {
    double const h = table.rows[static_cast<std::size_t>(k)].value;
    CHECK(table.rows[static_cast<std::size_t>(k)].errors[0] == samples::Approx(h * h / 12.0).epsilon(h * h / 50.0));
  }
  // the share h^2 / 60 at h = 1/4 and its like
  CHECK(table.rows[1].orders[0] == samples::Approx(2.0).epsilon(2e-3));
  CHECK(std::isnan(table.rows[0].orders[0]));
  CHECK(std::isnan(table.reference_cost));
  CHECK(std::isnan(table.scatter[0]));
}

TEST_CASE("costs are relative to the base setting before and after a run, and the noise is what that changes by") {
  std::vector<error_vs_time::SweepRun> const runs(3);
  error_vs_time::SweepEvaluation evaluation("clock", runs, false, false);
  auto const took = [](double seconds) {
    Measured measured{.inner_steps = 8};
    measured.add("time", 1.0);
    return error_vs_time::TimedRun{.measured = measured, .seconds = seconds};
  };
  evaluation.reference(took(30.0));
  evaluation.baseline(took(1.0));
  evaluation.add(0, took(2.0));
  evaluation.add(1, took(6.0));
  evaluation.baseline(took(3.0));
  evaluation.add(2, took(6.0));
  auto const table = evaluation.table();
  // Analytic: 6 s over the mean of 1 and 3 s; over 3 s, behind which no other comes; 30 s over the median of 1 and 3 s.
  CHECK(table.rows[0].cost == 1.0);
  CHECK(table.rows[1].cost == samples::Approx(3.0).epsilon(1e-14));
  CHECK(table.rows[2].cost == samples::Approx(2.0).epsilon(1e-14));
  CHECK(table.rows[1].seconds == 6.0);
  CHECK(table.rows[1].inner_steps == 8.0);
  CHECK(table.reference_cost == samples::Approx(15.0).epsilon(1e-14));
  CHECK(table.cost_noise == samples::Approx(2.0).epsilon(1e-14));
}

TEST_CASE("errors that do not follow a power have no order") {
  auto const order = error_vs_time::order_of_errors({1.0, 0.5, 0.25}, {0.1, 0.09, 0.01});
  CHECK_FALSE(order.holds());
  CHECK(std::isnan(order.value()));
  CHECK(error_vs_time::order_of_errors({1.0, 0.5}, {0.1, 0.0}).estimates.empty());
}

TEST_CASE("the front holds what nothing beats") {
  error_vs_time::SweepTable table{.name = "by hand", .responses = {"stress"}};
  auto const add = [&](char const* setting, double cost, double error) {
    table.rows.push_back({.knob = "k", .setting = setting, .cost = cost, .errors = {error}});
  };
  double const none = std::numeric_limits<double>::quiet_NaN();
  add("base", 1.0, 0.05);
  add("cheap", 0.5, 0.2);
  add("beaten", 1.5, 0.06);
  add("fine", 4.0, 0.01);
  add("failed", 0.1, none);
  add("as good but dearer", 6.0, 0.01);
  table.scatter = {none};
  auto const front = table.front("stress");
  REQUIRE(front.size() == 3);
  CHECK(front[0].setting == "cheap");
  CHECK(front[1].setting == "base");
  CHECK(front[2].setting == "fine");
  // Costs that differ by less than the noise count as equal: the base setting is then beaten by what costs 1.5 times as
  // much.
  table.rows[2].errors[0] = 0.04;
  table.cost_noise = 0.6;
  REQUIRE(table.front("stress").size() == 3);
  CHECK(table.front("stress")[1].setting == "beaten");
  CHECK_THROWS_WITH_AS(table.front("strain"), doctest::Contains("it has: stress"), scarp::InputError);
}

TEST_CASE("samples have references of their own, their scatter is told, and failed runs keep their reason") {
  // Sample k answers (10 + k) (1 + size).
  auto const measure = [](Settings const& settings, int sample) {
    Measured measured;
    measured.add("load", (10.0 + sample) * (1.0 + settings.size) / (settings.size == 0.5 ? 0.0 : 1.0));
    if (settings.size > 1.0) measured.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
    return measured;
  };
  error_vs_time::Sweep sweep("samples", Settings{}, measure);
  sweep.min_seconds = 0.0;
  sweep.reference({.size = 0.0});
  sweep.vary("size", [](Settings& settings, double value) { settings.size = value; }, {0.1, 0.5, 2.0});
  sweep.vary_sample("sides", [](Settings& settings, double) { settings.size = 0.0; }, {0.7 * 7.0});
  auto const table = sweep.run(3);
  CHECK(table.rows[1].errors[0] == samples::Approx(0.1));
  CHECK(table.rows[2].verdict.reason == scarp::Reason::not_finite);
  CHECK(table.rows[3].verdict.reason == scarp::Reason::unbalanced);
  CHECK(std::isnan(table.rows[3].errors[0]));
  CHECK(table.scatter[0] == samples::Approx(1.0 / 11.0));                          // of 10, 11, 12
  CHECK(table.rows[4].errors[0] == samples::Approx(std::sqrt(2.0 / 3.0) / 11.0));  // about the mean of the samples
  CHECK(table.rows[4].setting == "4.9");
  for (auto const& row : table.front("load")) CHECK_FALSE(row.new_sample);
  CHECK(table.csv().find("size,2,2,") != std::string::npos);
  CHECK(table.csv().find("not_converged,unbalanced") != std::string::npos);
}

TEST_CASE("an order is that of the runs that were answered") {
  error_vs_time::Sweep sweep("trapezoids", Settings{}, [](Settings const& settings) {
    Measured measured = integral(settings);
    if (settings.size == 0.125) measured.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
    return measured;
  });
  sweep.min_seconds = 0.0;
  sweep.exact(exact_integral());
  sweep.vary("size", &Settings::size, {0.25, 0.125, 0.0625, 0.03125});
  auto const table = sweep.run();
  CHECK(table.rows[1].orders[0] == samples::Approx(2.0).epsilon(2e-3));
  CHECK(std::isnan(table.rows[2].orders[0]));
}

TEST_CASE("lists of types are settings like any other") {
  error_vs_time::Sweep sweep("rules", Settings{}, integral);
  sweep.min_seconds = 0.0;
  sweep.exact(exact_integral());
  sweep.vary_over<Rectangles, Trapezoids>("rule", {"rectangles", "trapezoids"},
                                          [](auto rule, Settings const& settings) {
                                            Measured measured;
                                            measured.add("integral", rule.sum(settings.size));
                                            return measured;
                                          });
  sweep.vary("size", &Settings::size, {0.5, 0.25});
  auto const table = sweep.run();
  REQUIRE(table.rows.size() == 1 + 2 + 2);
  CHECK(table.rows[1].errors[0] > 10.0 * table.rows[2].errors[0]);  // h / 2 against h^2 / 12, h = 1/4
}

TEST_CASE("answers that cannot be compared are refused before any time is lost on them") {
  error_vs_time::Sweep sweep("trapezoids", Settings{}, integral);
  CHECK_THROWS_WITH_AS(sweep.run(), doctest::Contains("has no reference"), scarp::InputError);
  Measured zero;
  zero.add("integral", 0.0);
  sweep.exact(zero);
  CHECK_THROWS_WITH_AS(sweep.run(), doctest::Contains("is zero"), scarp::InputError);
  CHECK_REFUSED(sweep.run(0), "repetitions", "is 0");
  Measured failed;
  failed.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
  sweep.exact(failed);
  CHECK_REFUSED(sweep.run(), "reference of sweep 'trapezoids'", "unbalanced");
  Measured longer;
  longer.add("integral", Eigen::VectorXd::Ones(2));
  sweep.exact(longer);
  CHECK_THROWS_WITH_AS(sweep.run(), doctest::Contains("other names or lengths"), scarp::InputError);
}

TEST_CASE("references of different samples have to be alike, and the base setting has to work") {
  auto const answers = [](Settings const& settings, int repetition) {
    Measured measured;
    measured.add("values", Eigen::VectorXd::Ones(1 + (settings.sides == 5 ? repetition : 0)));
    if (settings.sides == 6) measured.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
    return measured;
  };
  error_vs_time::Sweep uneven("uneven", Settings{}, answers);
  uneven.reference({.sides = 5});
  CHECK_THROWS_WITH_AS(uneven.run(2), doctest::Contains("the reference of sweep 'uneven' gives responses"),
                       scarp::InputError);
  error_vs_time::Sweep broken("broken", Settings{.sides = 6}, answers);
  broken.reference({});
  CHECK_THROWS_WITH_AS(broken.run(), doctest::Contains("the base setting of sweep 'broken' ended with"),
                       scarp::InputError);
}

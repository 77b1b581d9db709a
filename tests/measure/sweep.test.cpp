// SPDX-License-Identifier: BSL-1.0
#include "scarp/measure/sweep.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace {

using scarp::Measured;

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
  measured.answer("integral", trapezoids(settings.size));
  return measured;
}

Measured exact_integral() {
  Measured exact;
  exact.answer("integral", std::exp(1.0) - 1.0);
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
  scarp::Sweep sweep("trapezoids", Settings{}, integral);
  sweep.least_seconds = 0.0;
  sweep.exact(exact_integral());
  sweep.vary("size", &Settings::size, {0.25, 0.125, 0.0625, 0.03125});
  auto const table = sweep.run();
  REQUIRE(table.rows.size() == 5);
  CHECK(table.rows[1].inner_steps == 4.0);
  // Analytic: h^2 / 12 of the integral itself, up to a share h^2 / 60 (Euler and Maclaurin).
  for (int k = 1; k <= 4; ++k) {
    double const h = table.rows[static_cast<std::size_t>(k)].value;
    CHECK(table.rows[static_cast<std::size_t>(k)].errors[0] == doctest::Approx(h * h / 12.0).epsilon(h * h / 50.0));
  }
  REQUIRE(table.orders.size() == 1);
  for (auto const& order : {table.orders[0].to_reference, table.orders[0].richardson}) {
    CHECK(order.holds());
    CHECK(order.mean() == doctest::Approx(2.0).epsilon(2e-3));  // the share h^2 / 60 at h = 1/4 and its like
  }
  CHECK(table.orders[0].richardson.estimates.size() == 2);
  CHECK(std::isnan(table.reference_cost));
  CHECK(std::isnan(table.scatter[0]));
}

TEST_CASE("costs are relative to the base setting before and after a run, and the noise is what that changes by") {
  std::vector<scarp::SweepRun> const runs(3);
  scarp::SweepEvaluation evaluation("clock", runs, false, false);
  auto const took = [](double seconds) {
    Measured measured{.inner_steps = 8};
    measured.answer("time", 1.0);
    return scarp::TimedRun{.measured = measured, .seconds = seconds};
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
  CHECK(table.rows[1].cost == doctest::Approx(3.0).epsilon(1e-14));
  CHECK(table.rows[2].cost == doctest::Approx(2.0).epsilon(1e-14));
  CHECK(table.rows[1].seconds == 6.0);
  CHECK(table.rows[1].inner_steps == 8.0);
  CHECK(table.reference_cost == doctest::Approx(15.0).epsilon(1e-14));
  CHECK(table.cost_noise == doctest::Approx(2.0).epsilon(1e-14));
}

TEST_CASE("Richardson's order needs neither equal ratios of the sizes nor a positive power") {
  for (double const power : {0.5, 1.0, 2.0, 4.0, -1.0}) {
    auto const value = [&](double h) { return std::pow(h, power); };
    double const order =
        scarp::richardson_order(0.5, 0.3, 0.1, std::abs(value(0.5) - value(0.3)), std::abs(value(0.3) - value(0.1)));
    CHECK(order == doctest::Approx(power).epsilon(1e-9));  // round-off of the differences
  }
}

TEST_CASE("errors that do not follow a power have no order and say so") {
  auto const order = scarp::order_of_errors({1.0, 0.5, 0.25}, {0.1, 0.09, 0.01});
  CHECK_FALSE(order.holds());
  CHECK(order.text() == "no order (0.2, 3.2)");  // log2 of 10/9 and of 9
  CHECK(scarp::order_of_errors({1.0, 0.5}, {0.1, 0.0}).text() == "-");
}

TEST_CASE("the front holds what nothing beats, and the recommendation is its cheapest row that is good enough") {
  scarp::SweepTable table{.name = "by hand", .answers = {"stress"}};
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
  REQUIRE(table.recommended("stress", 0.05).size() == 1);
  CHECK(table.recommended("stress", 0.05)[0].setting == "base");
  CHECK(table.recommended("stress", 0.005).empty());
  CHECK(table.excess_cost(2, "stress") == doctest::Approx(1.5));
  CHECK(table.excess_cost(0, "stress") == 1.0);
  // Costs that differ by less than the noise count as equal: the base setting is then beaten by what costs 1.5 times as
  // much.
  table.rows[2].errors[0] = 0.04;
  table.cost_noise = 0.6;
  REQUIRE(table.front("stress").size() == 3);
  CHECK(table.front("stress")[1].setting == "beaten");
  CHECK_THROWS_WITH_AS(table.front("strain"), doctest::Contains("it has: stress"), scarp::InputError);
}

TEST_CASE("a table for people has a row for each setting and answer, and the scatter of the samples below") {
  scarp::SweepTable table{.name = "by hand", .answers = {"stress", "strain"}};
  table.rows.push_back({.knob = "base", .setting = "base", .cost = 1.0, .inner_steps = 8.0, .errors = {0.05, 0.01}});
  table.rows.push_back({.knob = "k", .setting = "dear", .cost = 2.0, .inner_steps = 9.0, .errors = {0.02, 0.03}});
  table.scatter = {0.1, 0.0025};
  CHECK(table.markdown() ==
        "| knob | setting | CPU time / base | inner steps | stress | strain |\n"
        "|---|---|---|---|---|---|\n"
        "| base | base | 1 | 8 | **5 %** | **1 %** |\n"
        "| k | dear | 2 | 9 | **2 %** | 3 % |\n"
        "| base | scatter of the samples | | | 10 % | 0.25 % |\n");
}

TEST_CASE("samples have references of their own, their scatter is told, and failed runs keep their reason") {
  // Sample k answers (10 + k) (1 + size).
  auto const measure = [](Settings const& settings, int sample) {
    Measured measured;
    measured.answer("load", (10.0 + sample) * (1.0 + settings.size) / (settings.size == 0.5 ? 0.0 : 1.0));
    if (settings.size > 1.0) measured.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
    return measured;
  };
  scarp::Sweep sweep("samples", Settings{}, measure);
  sweep.least_seconds = 0.0;
  sweep.reference({.size = 0.0});
  sweep.vary("size", [](Settings& settings, double value) { settings.size = value; }, {0.1, 0.5, 2.0});
  sweep.vary_sample("sides", [](Settings& settings, double) { settings.size = 0.0; }, {0.7 * 7.0});
  auto const table = sweep.run(3);
  CHECK(table.rows[1].errors[0] == doctest::Approx(0.1));
  CHECK(table.rows[2].verdict.reason == scarp::Reason::not_finite);
  CHECK(table.rows[3].verdict.reason == scarp::Reason::unbalanced);
  CHECK(std::isnan(table.rows[3].errors[0]));
  CHECK(table.scatter[0] == doctest::Approx(1.0 / 11.0));                          // of 10, 11, 12
  CHECK(table.rows[4].errors[0] == doctest::Approx(std::sqrt(2.0 / 3.0) / 11.0));  // about the mean of the samples
  CHECK(table.rows[4].setting == "4.9");
  for (auto const& row : table.front("load")) CHECK_FALSE(row.new_sample);
  CHECK(table.markdown().find("not_converged (unbalanced)") != std::string::npos);
  CHECK(table.csv().find("size,2,load,2,") != std::string::npos);
}

TEST_CASE("an order is that of the runs that were answered") {
  scarp::Sweep sweep("trapezoids", Settings{}, [](Settings const& settings) {
    Measured measured = integral(settings);
    if (settings.size == 0.125) measured.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
    return measured;
  });
  sweep.least_seconds = 0.0;
  sweep.exact(exact_integral());
  sweep.vary("size", &Settings::size, {0.25, 0.125, 0.0625, 0.03125});
  auto const table = sweep.run();
  REQUIRE(table.orders.size() == 1);
  CHECK(table.orders[0].to_reference.mean() == doctest::Approx(2.0).epsilon(2e-3));
  CHECK(table.orders[0].to_reference.estimates.size() == 2);
}

TEST_CASE("lists of types and pairs of knobs are settings like any other") {
  scarp::Sweep sweep("rules", Settings{}, integral);
  sweep.least_seconds = 0.0;
  sweep.exact(exact_integral());
  sweep.vary_over<Rectangles, Trapezoids>("rule", {"rectangles", "trapezoids"},
                                          [](auto rule, Settings const& settings) {
                                            Measured measured;
                                            measured.answer("integral", rule.sum(settings.size));
                                            return measured;
                                          });
  sweep.vary("size", &Settings::size, {0.5, 0.25});
  sweep.vary("sides", &Settings::sides, {3, 4});
  sweep.combine("size", "sides");
  auto const table = sweep.run();
  REQUIRE(table.rows.size() == 1 + 2 + 2 + 2 + 4);
  CHECK(table.rows[1].errors[0] > 10.0 * table.rows[2].errors[0]);  // h / 2 against h^2 / 12, h = 1/4
  CHECK(table.rows.back().setting == "size 0.25, sides 4");
  CHECK_THROWS_WITH_AS(sweep.combine("size", "colour"), doctest::Contains("no knob 'colour'"), scarp::InputError);
}

TEST_CASE("answers that cannot be compared are refused before any time is lost on them") {
  scarp::Sweep sweep("trapezoids", Settings{}, integral);
  CHECK_THROWS_WITH_AS(sweep.run(), doctest::Contains("has no reference"), scarp::InputError);
  Measured zero;
  zero.answer("integral", 0.0);
  sweep.exact(zero);
  CHECK_THROWS_WITH_AS(sweep.run(), doctest::Contains("is zero"), scarp::InputError);
  Measured longer;
  longer.answer("integral", Eigen::VectorXd::Ones(2));
  sweep.exact(longer);
  CHECK_THROWS_WITH_AS(sweep.run(), doctest::Contains("other names or lengths"), scarp::InputError);
}

TEST_CASE("references of different samples have to be alike, and the base setting has to work") {
  auto const answers = [](Settings const& settings, int repetition) {
    Measured measured;
    measured.answer("values", Eigen::VectorXd::Ones(1 + (settings.sides == 5 ? repetition : 0)));
    if (settings.sides == 6) measured.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
    return measured;
  };
  scarp::Sweep uneven("uneven", Settings{}, answers);
  uneven.reference({.sides = 5});
  CHECK_THROWS_WITH_AS(uneven.run(2), doctest::Contains("the reference of sweep 'uneven' gives answers"),
                       scarp::InputError);
  scarp::Sweep broken("broken", Settings{.sides = 6}, answers);
  broken.reference({});
  CHECK_THROWS_WITH_AS(broken.run(), doctest::Contains("the base setting of sweep 'broken' ended with"),
                       scarp::InputError);
}

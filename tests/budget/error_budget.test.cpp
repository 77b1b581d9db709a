// SPDX-License-Identifier: BSL-1.0
#include "scarp/budget/error_budget.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "constitutive/nestings.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/points/material_points.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

/// Stress that relaxes towards 1 with the shortening, by explicit Euler steps: \f$ s' = 1 - s \f$. As many steps as
/// planned.
struct Relaxing {
  static constexpr int dim = 2;
  struct State {
    double s = 0.0;
    double sign = 1.0;
    SCARP_MEMBERS(s, sign)
  };
  using Plan = int;

  int steps = 4;
  int max_steps = 1000;
  double start = 0.0;
  bool alternates = false;  ///< every other point has the stress with the other sign

  State initial_state(scarp::Site<2> const& site) const {
    return {start, alternates && site.index % 2 == 1 ? -1.0 : 1.0};
  }
  scarp::VoigtStress<2> stress(State const& state) const { return {state.sign * state.s, state.sign * state.s, 0.0}; }
  scarp::VoigtTangent<2> tangent(State const&) const { return scarp::VoigtTangent<2>::Identity(); }
  Plan plan(State const&, scarp::Gradient<2> const&) const { return steps; }
  Plan refined(Plan plan) const { return std::min(2 * plan, max_steps); }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    return respond(committed, increment, trial, steps);
  }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial,
                             Plan plan) const {
    trial = committed;
    double const step = std::log1p(increment(0, 0)) / plan;
    for (int k = 0; k < plan; ++k) trial.s += step * (1.0 - trial.s);
    return {stress(trial), {}};
  }
};
static_assert(scarp::HasPlan<Relaxing>);

/// Constant pressure, but for point 0: it carries nothing, and twice the steps leave a residue of stress or fail.
struct Loosened {
  static constexpr int dim = 2;
  struct State {
    double pressure = 0.0;
    int index = 0;
    SCARP_MEMBERS(pressure, index)
  };
  using Plan = int;

  double residue = 0.0;
  bool fails = false;

  State initial_state(scarp::Site<2> const& site) const { return {site.index == 0 ? 0.0 : 1e5, site.index}; }
  scarp::VoigtStress<2> stress(State const& state) const { return {-state.pressure, -state.pressure, 0.0}; }
  scarp::VoigtTangent<2> tangent(State const&) const { return scarp::VoigtTangent<2>::Identity(); }
  Plan plan(State const&, scarp::Gradient<2> const&) const { return 4; }
  Plan refined(Plan plan) const { return 2 * plan; }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    return respond(committed, increment, trial, 4);
  }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const&, State& trial, Plan plan) const {
    trial = committed;
    if (trial.index > 0) return {stress(trial), {}};
    trial.pressure = plan > 4 ? residue : 0.0;
    if (fails && plan > 4) return {stress(trial), {scarp::Status::failed, scarp::Reason::not_finite}};
    return {stress(trial), {}};
  }
};
static_assert(scarp::HasPlan<Loosened>);

/// What a budget sees of a problem, without any solver: all points are strained alike.
class Points {
 public:
  static constexpr int dim = 2;

  template <class Material>
  Points(Material const& material, int count) : points_(material, numbered(count)) {}

  static bool has_attachment() { return true; }  // no work is added up
  static bool has_field() { return false; }
  auto const& points() const { return points_; }
  auto const& gradients() const { return points_.gradients(); }
  scarp::SerialExecutor& executor() const { return serial_; }

  void strain(double increment, scarp::ErrorBudget<Points>& budget) {
    for (int point = 0; point < points_.size(); ++point)
      points_.gradient(point) = scarp::Gradient<2>::Identity() * std::expm1(increment);
    scarp::StepReport report;
    report.history.emplace_back().residual = 1e-4;
    report.history.back().inner_steps = points_.respond(serial_).inner_steps;
    points_.commit();
    budget.attempted(*this, report);
  }

 private:
  static std::vector<scarp::Site<2>> numbered(int count) {
    std::vector<scarp::Site<2>> sites(static_cast<std::size_t>(count));
    for (int point = 0; point < count; ++point) sites[static_cast<std::size_t>(point)].index = point;
    return sites;
  }

  scarp::MaterialPoints<2> points_;
  mutable scarp::SerialExecutor serial_{};
};

constexpr double increment = 0.02;

/// Analytic: s = 1 - (1 - e/n)^n after n steps over the strain e.
double relaxed(int steps, double strain) { return 1.0 - std::pow(1.0 - strain / steps, steps); }

double part(scarp::BudgetParts const& parts, std::string_view name) {
  for (auto const& part : parts)
    if (part.name == name) return part.value;
  return -1.0;
}

}  // namespace

TEST_CASE("the mean of what is unbalanced is that of the packings that were looked at, and nothing before") {
  CHECK(scarp::PackingSurvey{}.mean_unbalanced() == 0.0);
  CHECK(scarp::PackingSurvey{.looked_at = 4.0, .unbalanced_sum = 1.0}.mean_unbalanced() == 0.25);
}

TEST_CASE("the budget finds the known error of a law's steps in single increments and along the path") {
  for (int const max_steps : {1000, 4}) {  // by a refined plan, and in halves where no more than four steps are allowed
    Points points(Relaxing{.steps = 4, .max_steps = max_steps}, 50);
    scarp::ErrorBudget budget(points, {}, {.share = 1.0, .points_per_tracked = 100, .tracked = {7}});
    constexpr int increments = 10;
    for (int k = 0; k < increments; ++k) points.strain(increment, budget);
    REQUIRE(budget.samples().count() >= 20);
    CHECK(budget.samples().strained.differences[0] ==
          samples::Approx(1.0 - relaxed(8, increment) / relaxed(4, increment)).epsilon(1e-10));
    // The second answers begin after the first increment, with the first one's state.
    double const start = 1.0 - relaxed(4, increment);
    double const once = 1.0 - start * std::pow(1.0 - increment / 4.0, 4 * (increments - 1));
    double const twice = 1.0 - start * std::pow(1.0 - increment / 8.0, 8 * (increments - 1));
    REQUIRE(budget.tracked().points.size() == 1);
    CHECK(budget.tracked().points[0].point == 7);
    CHECK(budget.tracked().points[0].apart == samples::Approx(1.0 - twice / once).epsilon(1e-10));
    CHECK(part(budget.parts(), "accumulated") ==
          samples::Approx(part(budget.parts(), "accumulated_apart")).epsilon(1e-10));
  }
}

TEST_CASE("points that have lost most of their stress are compared with what they carried at the beginning") {
  constexpr double start = 100.0;
  Points points(Relaxing{.start = start}, 50);
  scarp::ErrorBudget budget(points, {}, {.share = 1.0, .points_per_tracked = 100, .tracked = {7}});
  constexpr double large = 0.5;
  constexpr int increments = 8;
  for (int k = 0; k < increments; ++k) points.strain(large, budget);
  // The deviation from 1 falls by this factor in an increment of four and of eight steps.
  double const once = std::pow(1.0 - large / 4.0, 4);
  double const twice = std::pow(1.0 - large / 8.0, 8);
  double const before_last = (start - 1.0) * std::pow(once, increments - 1);
  CHECK(budget.samples().spread.differences.back() ==
        samples::Approx(before_last * (twice - once) / start).epsilon(1e-10));
  double const tracked = (start - 1.0) * once * (std::pow(twice, increments - 1) - std::pow(once, increments - 1));
  CHECK(budget.tracked().points[0].apart == samples::Approx(tracked / start).epsilon(1e-10));
}

TEST_CASE("round-off at a point that carries nothing is no error, and a failed answer is one without end") {
  scarp::ErrorSampling const sampling{.share = 1.0, .points_per_tracked = 100, .tracked = {0, 7, 30}};
  Points loose(Loosened{.residue = 1e-8}, 50);
  scarp::ErrorBudget budget(loose, {}, sampling);
  for (int k = 0; k < 5; ++k) loose.strain(increment, budget);
  REQUIRE(budget.tracked().points[0].point == 0);
  CHECK(scarp::budget_headline(budget.parts()) == "");
  // A residue of 1e-13 of the largest stress, over a share of 1e-9 of it.
  CHECK(part(budget.parts(), "accumulated_largest") == samples::Approx(1e-4).epsilon(1e-10));
  CHECK(part(budget.parts(), "doubling_largest") == samples::Approx(1e-4).epsilon(1e-10));
  CHECK(part(budget.parts(), "accumulated") < 1e-12);

  Points failing(Loosened{.fails = true}, 50);
  scarp::ErrorBudget endless(failing, {}, sampling);
  for (int k = 0; k < 5; ++k) failing.strain(increment, endless);
  CHECK(std::isinf(part(endless.parts(), "accumulated")));
}

TEST_CASE("differences of tracked points that cancel are no error of all of them") {
  Points points(Relaxing{.alternates = true}, 50);
  scarp::ErrorBudget all(points, {}, {.points_per_tracked = 100, .tracked = {6, 7}});
  scarp::ErrorBudget one(points, {}, {.points_per_tracked = 100, .tracked = {7}});
  for (int k = 0; k < 5; ++k) {
    points.strain(increment, all);
    points.strain(increment, one);
  }
  CHECK(part(all.parts(), "accumulated") < 1e-15);
  CHECK(part(all.parts(), "accumulated_apart") > 1e-4);
  CHECK(part(one.parts(), "accumulated") > 1e-4);
}

TEST_CASE("what tracked points have in common is found whole, and what is apart by chance is left out") {
  Points alike(Relaxing{}, 50);
  scarp::ErrorBudget budget(alike, {}, {.points_per_tracked = 100, .tracked = {6, 7, 30}});
  for (int k = 0; k < 5; ++k) alike.strain(increment, budget);
  double const own = part(budget.parts(), "accumulated_apart");
  REQUIRE(own > 1e-4);
  CHECK(part(budget.parts(), "accumulated") == samples::Approx(own).epsilon(1e-10));

  // Two of one sign and one of the other have a sum, but no pair product on average.
  Points apart(Relaxing{.alternates = true}, 50);
  scarp::ErrorBudget mixed(apart, {}, {.points_per_tracked = 100, .tracked = {6, 7, 8}});
  for (int k = 0; k < 5; ++k) apart.strain(increment, mixed);
  CHECK(part(mixed.parts(), "accumulated_apart") == samples::Approx(own).epsilon(1e-10));
  CHECK(part(mixed.parts(), "accumulated") < 1e-12);
}

TEST_CASE("an elastic law has no error of its steps beyond the third order of the strain") {
  Points points(scarp::LinearElastic<2>::from_young_poisson(20e6, 0.3), 400);
  scarp::ErrorBudget budget(points, {}, {});
  for (int k = 0; k < 5; ++k) points.strain(1e-4, budget);
  CHECK(budget.tracked().points.size() == 10);
  REQUIRE(budget.samples().count() > 0);
  // Of increments of 1e-4: halves differ by the square of the strain over 16, and the sum of strains is no smaller.
  CHECK(part(budget.parts(), "doubling_largest") < 1e-9);
  CHECK(part(budget.parts(), "accumulated") < 1e-9);
  CHECK(scarp::budget_headline(budget.parts()) == "");
}

TEST_CASE("samples take no more work than their share") {
  Points points(Relaxing{}, 100);
  scarp::ErrorBudget budget(points, {}, {.share = 0.01, .max_samples = 50, .points_per_tracked = 1000});
  for (int k = 0; k < 20; ++k) points.strain(increment, budget);
  double const share = part(budget.parts(), "work_of_checks");
  CHECK(share <= 0.01);
  CHECK(share > 0.008);  // four steps a point: a sample of eight is one of 1/50 of an increment's work
}

TEST_CASE("a run outside its budget says by which part, with NaN counted as outside") {
  Points points(Relaxing{}, 50);
  scarp::ErrorBudget budget(points, {.residual = 1e-5, .doubling_median = 1.0}, {.share = 1.0});
  points.strain(increment, budget);
  CHECK(scarp::budget_headline(budget.parts()) == "OUTSIDE ITS ERROR BUDGET: residual is 0.0001, bound 1e-05\n");
  CHECK(!scarp::BudgetPart{.value = std::nan(""), .bound = 1.0}.is_within());
  CHECK_REFUSED(scarp::ErrorBudget(points, {}, {.tracked = {50}}), "point 50");
}

TEST_CASE("a quantile is not exceeded by its share of the samples, however few they are") {
  auto const first = [](int count) {
    scarp::SampledDifferences samples;
    for (int k = count; k > 0; --k) {
      samples.differences.push_back(k);
      samples.carried.push_back(1.0);
    }
    return samples;
  };
  CHECK(scarp::SampledDifferences{}.quantile(0.95) == 0.0);
  CHECK(first(1).quantile(0.95) == 1.0);
  CHECK(first(2).quantile(0.95) == 2.0);
  CHECK(first(2).quantile(0.5) == 1.0);
  CHECK(first(10).quantile(0.95) == 10.0);
  CHECK(first(20).quantile(0.95) == 19.0);
  CHECK(first(3).quantile(0.0) == 1.0);
}

TEST_CASE("a sample counts by the stress that it carries") {
  scarp::SampledDifferences const samples{.differences = {0.3, 0.1, 0.2}, .carried = {1.0, 60.0, 39.0}};
  CHECK(samples.quantile(0.5) == 0.1);
  CHECK(samples.quantile(0.95) == 0.2);
  CHECK(samples.quantile(1.0) == 0.3);
  // Of a point without stress no share counts, but it is the largest.
  scarp::SampledDifferences const lost{.differences = {0.01, std::numeric_limits<double>::infinity(), 0.02},
                                       .carried = {1.0, 0.0, 1.0}};
  CHECK(lost.quantile(1.0) == 0.02);
  CHECK(lost.largest() == std::numeric_limits<double>::infinity());
}

TEST_CASE("a step has as many samples as it may, none twice, and the most strained point in every other one") {
  Points points(Relaxing{}, 50);
  scarp::ErrorBudget budget(points, {}, {.share = 10.0, .max_samples = 5});
  points.strain(increment, budget);
  points.strain(increment, budget);
  CHECK(budget.samples().count() == 10);
  CHECK(budget.samples().strained.differences.size() == 2);
  Points few(Relaxing{}, 3);
  scarp::ErrorBudget small(few, {}, {.share = 10.0, .max_samples = 5});
  few.strain(increment, small);
  CHECK(small.samples().count() == 3);
}

TEST_CASE("a number that is none puts a run outside its budget for good") {
  Points points(Relaxing{}, 50);
  scarp::ErrorBudget budget(points);
  scarp::StepReport report;
  report.history.emplace_back().linear_residual = std::nan("");
  budget.attempted(points, report);
  points.strain(increment, budget);
  CHECK(std::isnan(part(budget.parts(), "linear_residual")));
  CHECK(scarp::budget_headline(budget.parts()).find("linear_residual") != std::string::npos);
}

TEST_CASE("sampling that cannot be done is refused") {
  Points points(Relaxing{}, 50);
  CHECK_REFUSED(scarp::ErrorBudget(points, {}, {.max_samples = -1}), "samples of a step is -1");
  CHECK_REFUSED(scarp::ErrorBudget(points, {}, {.points_per_tracked = 0}), "points for a tracked one is 0");
  CHECK_REFUSED(scarp::ErrorBudget(points, {}, {.max_tracked = -1}), "tracked points is -1");
  CHECK_REFUSED(scarp::ErrorBudget(points, {}, {.share = std::nan("")}), "share of work for samples is nan");
  CHECK_REFUSED(scarp::ErrorBudget(points, {}, {.pressure_floor = -1.0}), "pressure floor is -1");
}

TEST_CASE("the budget is complete whatever adaptor is around a packing") {
  auto const check = [](auto const& material) {
    Points points(material, 5);
    scarp::ErrorBudget budget(points);
    points.strain(-5e-4, budget);  // more than is predicted at once
    auto const parts = budget.parts();
    CHECK(part(parts, "unbalanced_mean") == 1e-3);
    CHECK(part(parts, "unbalanced_largest") == 1e-3);
    CHECK(part(parts, "kinetic_share") == 1e-4);
    CHECK(part(parts, "inertial_number") > 0.0);
  };
  nestings::for_each([&](std::string const& name, auto const& provider) {
    CAPTURE(name);
    check(provider);
  });
  nestings::for_each_adaptor([&](auto adaptor) {
    CAPTURE(std::string(adaptor.name));
    check(adaptor.around(nestings::Loosening{}));
    check(scarp::AnyProvider<2>(adaptor.around(nestings::Loosening{})));
  });
}

TEST_CASE("bounds that are negative or no number are refused, by name") {
  Points points(Relaxing{}, 50);
  CHECK_REFUSED(scarp::ErrorBudget(points, {.residual = -1.0}), "budget's residual is -1");
  CHECK_REFUSED(scarp::ErrorBudget(points, {.accumulated = std::nan("")}), "budget's accumulated is nan");
  CHECK_NOTHROW(scarp::ErrorBudget(points, {.mesh = std::numeric_limits<double>::infinity()}));
  CHECK_REFUSED((scarp::Sensitivity{-14.0, -15.0, 25.0, std::nan("")}.part("mesh", "place")), "bound", "is nan");
}

TEST_CASE("a run of one step has no second path yet, and does not pass for exact") {
  Points points(Relaxing{}, 50);
  scarp::ErrorBudget budget(points, {}, {.points_per_tracked = 100, .tracked = {7}});
  points.strain(increment, budget);
  CHECK(part(budget.parts(), "accumulated") == -1.0);
  points.strain(increment, budget);
  CHECK(part(budget.parts(), "accumulated") > 0.0);
}

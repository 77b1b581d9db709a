// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/critical_step.hpp"

#include <doctest/doctest.h>

#include "support/approx.hpp"
#include "support/packings.hpp"

namespace {

using samples::SmoothDiscs;
using scarp::Tensor;

constexpr scarp::Frictionless smooth{.normal_stiffness = 6e6};

/// Largest speed after undamped steps of a lattice that was nudged by 1e-9 m/s at random; `share` of the listed step.
double speed_after(int steps, double share) {
  auto packing = samples::triangular_lattice<SmoothDiscs>(4, 5e-3, 1e-2 * (1.0 - 1e-4));
  scarp::Random random(23);
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    for (int a = 0; a < 2; ++a) packing.velocity(i, a) = random.uniform(-1e-9, 1e-9);
  }
  scarp::TimeStepper<SmoothDiscs> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  stepper.time_step_share = share;
  for (int step = 0; step < steps; ++step) {
    if (!stepper.step(packing, smooth, Tensor<2>::Zero()).acceptable()) return 1e300;
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    largest = std::max(largest, std::hypot(packing.velocity(i, 0), packing.velocity(i, 1)));
  }
  return largest;
}

double bound_of_lattice() {
  auto packing = samples::triangular_lattice<SmoothDiscs>(4, 5e-3, 1e-2 * (1.0 - 1e-4));
  REQUIRE(scarp::rebuild_pairs(packing, 1e-4).acceptable());
  return scarp::critical_step(packing, smooth);
}

/// Analytic: omega_max^2 = 6 k_n / m at the edge of the Brillouin zone, which a period of four rows contains.
double exact_limit_of_lattice() {
  double const mass = samples::density * samples::thickness * scarp::Disc::content({5e-3});
  return 2.0 / std::sqrt(6.0 * smooth.normal_stiffness / mass);
}

}  // namespace

TEST_CASE("the critical step of a lattice is a bound below its exact limit") {
  double const mass = samples::density * samples::thickness * scarp::Disc::content({5e-3});
  CHECK(exact_limit_of_lattice() == samples::Approx(0.8165 * std::sqrt(mass / smooth.normal_stiffness)).epsilon(1e-4));
  double const bound = bound_of_lattice();
  CHECK(bound <= exact_limit_of_lattice());
  // Analytic: six equal pairs share each grain, one alone has omega^2 = k_n (6/m + 6/m).
  CHECK(bound == samples::Approx(2.0 / std::sqrt(12.0 * smooth.normal_stiffness / mass)).epsilon(1e-12));
}

TEST_CASE("in a row of grains the bound is sharp") {
  // Analytic: the limit of a row is 2 / sqrt(4 k_n / m).
  Tensor<2> cell;
  cell << 2e-2 * (1.0 - 1e-4), 0.0, 0.0, 4e-2;
  auto row = samples::place<SmoothDiscs>(cell, {{5e-3}, {5e-3}}, {{2e-3, 1e-2}, {2e-3 + 0.5 * cell(0, 0), 1e-2}});
  REQUIRE(scarp::rebuild_pairs(row, 1e-4).acceptable());
  double const mass = samples::density * samples::thickness * scarp::Disc::content({5e-3});
  double const limit = 2.0 / std::sqrt(4.0 * smooth.normal_stiffness / mass);
  CHECK(scarp::critical_step(row, smooth) == samples::Approx(limit).epsilon(1e-12));
}

TEST_CASE("the scheme is stable at the bound and just below the exact limit, and blows up above it") {
  double const exact_share = exact_limit_of_lattice() / bound_of_lattice();
  double const still = speed_after(0, 1.0);
  CHECK(speed_after(2000, 1.0) < 20.0 * still);
  CHECK(speed_after(2000, 0.98 * exact_share) < 50.0 * still);  // near the limit leap-frog amplifies, but stays bounded
  // Analytic: at 1.05 of the limit the worst mode grows by 1.88 per step, by 1e5 within 20 steps.
  CHECK(speed_after(40, 1.05 * exact_share) > 1e4 * still);
}

TEST_CASE_TEMPLATE("a consolidated packing stays at rest at its bound", PackingType, samples::Discs,
                   samples::Ellipses) {
  auto const law = samples::study_law();
  auto packing = samples::consolidated<PackingType>(80).packing;
  scarp::TimeStepper<PackingType> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  scarp::StepObservation<2> seen;
  for (int step = 0; step < 3000; ++step) {
    REQUIRE(stepper.template step<scarp::Observe::balance>(packing, law, Tensor<2>::Zero(), &seen).acceptable());
  }
  CHECK(seen.unbalanced_ratio < 1e-3);  // started at 1e-5; an unstable mode would have grown without bound
}

TEST_CASE_TEMPLATE("one contact's stiffest mode is that of its springs, and rolling adds its own", Dim,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dim::value;
  scarp::Contact<dim> contact{};
  contact.touch.normal[0] = -0.6;
  contact.touch.normal[1] = 0.8;
  for (std::size_t a = 0; a < 2; ++a) {
    contact.touch.arm_first[a] = 0.5 * contact.touch.normal[a];
    contact.touch.arm_second[a] = -0.25 * contact.touch.normal[a];
  }
  auto const mode = [&](double normal, double tangential, double rolling) {
    return scarp::detail::stiffest_mode<dim>(contact, {.normal = normal, .tangential = tangential, .rolling = rolling},
                                             7.0, 4.0, 32.0);
  };
  // Analytic: springs along the normal move the centres alone, across it they turn each grain through its arm as well.
  CHECK(mode(3.0, 0.0, 0.0) == samples::Approx(3.0 * 7.0).epsilon(1e-12));
  CHECK(mode(0.0, 3.0, 0.0) == samples::Approx(3.0 * (7.0 + 4.0 * 0.25 + 32.0 * 0.0625)).epsilon(1e-12));
  CHECK(mode(2.0, 3.0, 0.0) == samples::Approx(30.0).epsilon(1e-12));
  CHECK(mode(2.0, 3.0, 0.5) == samples::Approx(30.0 + 0.5 * (4.0 + 32.0)).epsilon(1e-12));
}

TEST_CASE("arms that are not along the normal couple the springs of a contact") {
  scarp::Contact<2> contact{};
  contact.touch.normal = {1.0, 0.0};
  contact.touch.arm_first = {0.5, 1.0};
  contact.touch.arm_second = {0.0, 0.0};
  double const found = scarp::detail::stiffest_mode<2>(contact, {.normal = 4.0, .tangential = 1.0}, 7.0, 2.0, 0.0);
  // Analytic: arms across the axes are -1 (normal) and 0.5 (tangent), so that the matrix is [4 (7 + 2), -2; -2, 7 +
  // 0.5].
  CHECK(found == samples::Approx(21.75 + std::hypot(14.25, 2.0)).epsilon(1e-14));
}

TEST_CASE("loose grains have the step of the lightest between two others") {
  auto const packing = samples::place<SmoothDiscs>(Tensor<2>::Identity(), {{5e-3}, {2e-3}}, {{0.1, 0.1}, {0.7, 0.7}});
  double const lightest = samples::density * samples::thickness * scarp::Disc::content({2e-3});
  // Analytic: omega^2 = 4 k_n / m for a grain between two fixed walls whose springs count double.
  CHECK(scarp::critical_step(packing, smooth) ==
        samples::Approx(2.0 / std::sqrt(4.0 * smooth.normal_stiffness / lightest)).epsilon(1e-12));
}

namespace {
/// A spring that yields: a hundredth as stiff beyond an overlap [m].
struct Yielding {
  static constexpr scarp::ContactInputs inputs{};
  double normal_stiffness = 0.0;
  double yield = 0.0;

  template <int Dim, class T>
  constexpr scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                                scarp::ContactMemory<Dim, T>&) const {
    T const closed = scarp::lanes::at_least(approach.overlap, scarp::broadcast<T>(0));
    T const elastic = scarp::lanes::at_most(closed, scarp::broadcast<T>(yield));
    return {.normal =
                scarp::broadcast<T>(normal_stiffness) * (elastic + scarp::broadcast<T>(0.01) * (closed - elastic))};
  }
  constexpr scarp::ContactStiffness stiffness(double overlap, double) const {
    return {.normal = overlap < yield ? normal_stiffness : 0.01 * normal_stiffness};
  }
};
}  // namespace

TEST_CASE("the step of a law that softens with the overlap is that of its stiffest springs") {
  using Soft = scarp::Packing<scarp::Disc, Yielding>;
  auto elastic = samples::triangular_lattice<SmoothDiscs>(6, 5e-3, 9.95e-3);
  auto yielding = samples::triangular_lattice<Soft>(6, 5e-3, 9.95e-3);
  REQUIRE(scarp::TimeStepper<SmoothDiscs>{}.refresh(elastic, smooth).acceptable());
  REQUIRE(scarp::TimeStepper<Soft>{}.refresh(yielding, {smooth.normal_stiffness, 1e-4}).acceptable());
  CHECK(scarp::critical_step(yielding, {smooth.normal_stiffness, 1e-4}) == scarp::critical_step(elastic, smooth));
}

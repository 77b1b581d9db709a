// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <numbers>

#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/shape/clump.hpp"
#include "scarp/shape/minimum_translation.hpp"
#include "support/packings.hpp"

#include "support/approx.hpp"

namespace {

using samples::Discs;
using samples::Ellipses;
using samples::place;
using Dumbbells = scarp::Packing<scarp::Dumbbell, scarp::LinearFrictional>;
using Damped = scarp::HertzMindlin<scarp::HertzRestitution>;
using DampedDiscs = scarp::Packing<scarp::Disc, Damped>;
using scarp::Tensor;
using scarp::Vector;

constexpr double reach = 5e-3;  // half a grain along x [m]
constexpr scarp::LinearFrictional law{.normal_stiffness = 6e6, .tangential_stiffness = 4e6, .friction = 0.5};

template <class PackingType>
typename PackingType::Shape::template Size<double> size_along_x() {
  if constexpr (PackingType::Shape::size_count == 1) {
    return {reach};
  } else {
    return {reach, 0.75 * reach};
  }
}

/// Two grains, tip to tip along x, alone in a wide cell.
template <class PackingType>
PackingType free_pair(double overlap) {
  auto const size = size_along_x<PackingType>();
  return place<PackingType>(Tensor<2>::Identity(), {size, size}, {{0.5, 0.5}, {0.5 + 2.0 * reach - overlap, 0.5}});
}

/// The same two grains in a cell so narrow that each touches the other on both sides: an endless row along x, in which
/// the normal forces hold each other and only shear moves the grains.
template <class PackingType>
PackingType row(double overlap) {
  auto const size = size_along_x<PackingType>();
  Tensor<2> cell = Tensor<2>::Identity();
  double const spacing = 2.0 * reach - overlap;
  cell(0, 0) = 2.0 * spacing;
  return place<PackingType>(cell, {size, size}, {{0.25 * spacing, 0.5}, {1.25 * spacing, 0.5}});
}

template <class PackingType>
scarp::TimeStepper<PackingType> undamped(double share) {
  scarp::TimeStepper<PackingType> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  stepper.time_step_share = share;
  return stepper;
}

template <class PackingType>
void advance(scarp::TimeStepper<PackingType>& stepper, PackingType& packing) {
  REQUIRE(stepper.step(packing, law, Tensor<2>::Zero()).acceptable());
}

/// Phase after n steps of leap-frog from rest: velocities live half a step before positions, so the motion is
/// \f$ x_n = x_0 \cos(\Omega (n + 1/2)) / \cos(\Omega/2),\; \sin(\Omega/2) = \omega \Delta t/2 \f$, exactly.
double leap_frog_from_rest(double frequency, double time_step, int steps) {
  double const phase = 2.0 * std::asin(frequency * time_step / 2.0);
  return std::cos(phase * (steps + 0.5)) / std::cos(phase / 2.0);
}

}  // namespace

TEST_CASE_TEMPLATE("a pair released from overlap parts with the frequency of its spring", PackingType, Discs,
                   Ellipses) {
  constexpr double overlap = 1e-6;
  auto packing = free_pair<PackingType>(overlap);
  auto stepper = undamped<PackingType>(0.05);
  REQUIRE(stepper.refresh(packing, law).acceptable());
  double const time_step = stepper.time_step_share * packing.pairs.critical_step;
  // Analytic: omega = sqrt(k_n / m*), m* = m/2; leap-frog's own solution.
  double const frequency = std::sqrt(2.0 * law.normal_stiffness * packing.population->inverse_mass()[0]);
  int const last = static_cast<int>(1.5 / (frequency * time_step));  // before the quarter period pi/2
  REQUIRE(last > 20);
  for (int step = 1; step <= last; ++step) {
    advance(stepper, packing);
    double const present = 2.0 * reach - (packing.position(1, 0) - packing.position(0, 0));
    // Round-off of positions near 0.5 m, 1e-16, over the overlap, 1e-6, gathered over some hundred steps.
    CHECK(std::abs(present / overlap - leap_frog_from_rest(frequency, time_step, step)) < 1e-8);
  }
  CHECK(packing.spin(0, 0) == samples::Approx(0.0));
}

TEST_CASE_TEMPLATE("a collision lasts half a period of the spring and keeps the energy", PackingType, Discs, Ellipses) {
  auto packing = free_pair<PackingType>(-1e-6);
  constexpr double speed = 0.01;
  packing.velocity(0, 0) = speed;
  packing.velocity(1, 0) = -speed;
  auto stepper = undamped<PackingType>(0.01);
  REQUIRE(stepper.refresh(packing, law).acceptable());
  double const time_step = stepper.time_step_share * packing.pairs.critical_step;
  int touching = 0;
  int step = 0;
  for (bool parted = false; !parted && step < 100'000; ++step) {
    bool const closed = packing.position(1, 0) - packing.position(0, 0) < 2.0 * reach;
    touching += closed ? 1 : 0;
    parted = touching > 0 && !closed;
    advance(stepper, packing);
  }
  // Analytic: contact time pi sqrt(m*/k_n); counted in whole steps, hence at most one wrong.
  double const time = std::numbers::pi * std::sqrt(0.5 / packing.population->inverse_mass()[0] / law.normal_stiffness);
  CHECK(std::abs(touching * time_step - time) < 1.5 * time_step);
  CHECK(time > 50.0 * time_step);
  // The spring gives back what it took, up to first and last step's share (omega dt)^2 < 1e-3.
  CHECK(packing.velocity(0, 0) == samples::Approx(-speed).epsilon(1e-3));
  CHECK(packing.velocity(1, 0) == samples::Approx(speed).epsilon(1e-3));
}

TEST_CASE_TEMPLATE("a sliding row is slowed by friction alone, sticks, and then swings on its springs", PackingType,
                   Discs, Ellipses) {
  constexpr double overlap = 1e-6;
  constexpr double relative = 4e-3;  // speed of the second grain past the first [m/s]
  auto packing = row<PackingType>(overlap);
  auto stepper = undamped<PackingType>(0.005);
  REQUIRE(stepper.refresh(packing, law).acceptable());
  REQUIRE(packing.pairs.count() == 2);
  double const time_step = stepper.time_step_share * packing.pairs.critical_step;
  double const limit = law.friction * law.normal_stiffness * overlap;
  packing.velocity(0, 1) = -relative / 2.0;
  packing.velocity(1, 1) = relative / 2.0;
  // Both contacts slide from the start.
  // The tangent of a pair listed from right to left points down instead of up.
  for (std::size_t p = 0; p < 2; ++p) {
    bool const from_first = packing.pairs.first[p] == 0;
    bool const leftwards = scarp::row_position(packing, static_cast<std::size_t>(packing.pairs.second[p]))[0] <
                           scarp::row_position(packing, static_cast<std::size_t>(packing.pairs.first[p]))[0];
    packing.pairs.shear(p, 0) = (from_first ? -limit : limit) * (leftwards ? -1.0 : 1.0);
  }
  // Analytic: two contacts of force mu F_n on each grain, relative deceleration 4 mu F_n / m.
  double const deceleration = 4.0 * limit * packing.population->inverse_mass()[0];
  int const slides = static_cast<int>(0.95 * relative / (deceleration * time_step));
  REQUIRE(slides > 20);
  int step = 0;
  for (; step < slides; ++step) {
    advance(stepper, packing);
    double const speed = packing.velocity(1, 1) - packing.velocity(0, 1);
    // The row tilts by the path over the spacing, 1e-4 at the end; its square opens the contacts by 5e-5 of their
    // overlap, which costs a tenth of that in speed.
    CHECK(std::abs(speed - (relative - deceleration * time_step * (step + 1))) < 1e-5 * relative);
  }
  // Stuck: springs 2 k_t on relative motion with m/2 each, from the rest at the limit force.
  double const frequency = std::sqrt(4.0 * law.tangential_stiffness * packing.population->inverse_mass()[0]);
  double largest = 0.0;
  double smallest = 0.0;
  int crossings = 0;
  double former = packing.pairs.shear(0, 0);
  int first_crossing = 0;
  int last_crossing = 0;
  for (; crossings < 7 && step < 100 * slides; ++step) {
    advance(stepper, packing);
    double const shear = packing.pairs.shear(0, 0);
    largest = std::max(largest, shear);
    smallest = std::min(smallest, shear);
    if (shear * former < 0.0) {
      first_crossing = crossings == 0 ? step : first_crossing;
      last_crossing = step;
      ++crossings;
    }
    former = shear;
  }
  REQUIRE(crossings == 7);
  // Six half periods between the first and the last change of sign; two crossings are known to one step each.
  double const periods = (last_crossing - first_crossing) * time_step * frequency / (2.0 * std::numbers::pi);
  CHECK(std::abs(periods - 3.0) < 2.0 * time_step * frequency / (2.0 * std::numbers::pi) + 3e-3);
  // Analytic amplitude mu F_n: nothing is lost once the contact sticks. The last sliding step overshoots by (omega
  // dt)^2.
  CHECK(largest == samples::Approx(limit).epsilon(1e-2));
  CHECK(smallest == samples::Approx(-limit).epsilon(1e-2));
}

TEST_CASE_TEMPLATE("grains of a row spin on their tangential springs with their inertia", PackingType, Discs,
                   Ellipses) {
  constexpr double overlap = 1e-6;
  auto packing = row<PackingType>(overlap);
  auto stepper = undamped<PackingType>(0.05);
  REQUIRE(stepper.refresh(packing, law).acceptable());
  double const time_step = stepper.time_step_share * packing.pairs.critical_step;
  constexpr double spin = 1e-3;  // both grains the same way, small enough that nothing slides
  packing.spin(0, 0) = packing.spin(1, 0) = spin;
  // Analytic: two contacts, both grains roll into them, I w^2 = 4 k_t (r - overlap/2)^2; the normal force
  // of an ellipse's tip adds a share of about overlap / r = 2e-4 of it.
  double const arm = reach - overlap / 2.0;
  double const frequency = 2.0 * arm * std::sqrt(law.tangential_stiffness * packing.population->inverse_inertia()[0]);
  double const phase = 2.0 * std::asin(frequency * time_step / 2.0);
  int const last = static_cast<int>(6.28 / phase);
  REQUIRE(last > 50);
  double const tolerance = std::is_same_v<PackingType, Discs> ? 1e-8 : 2e-3;
  for (int step = 1; step <= last; ++step) {
    advance(stepper, packing);
    // Leap-frog: the first step finds the springs unstrained and leaves the spin as it is, half a step later.
    double const expected = std::cos(phase * (step - 0.5)) / std::cos(phase / 2.0);
    CHECK(std::abs(packing.spin(0, 0) / spin - expected) < tolerance);
    CHECK(std::abs(packing.spin(0, 0) - packing.spin(1, 0)) < 1e-9 * spin);
  }
  CHECK(std::abs(packing.velocity(0, 1)) < 1e-9 * spin * reach);
}

TEST_CASE("a pair whose normal stops being that of the least overlap takes the other one at once") {
  constexpr scarp::Ellipse::Size<double> slender{reach, 0.12 * reach};
  // A cross: along x they overlap by 1.12 of the reach less the distance along x, along y alike.
  auto packing =
      place<Ellipses>(Tensor<2>::Identity(), {slender, slender}, {{0.5, 0.5}, {0.5 + 0.3 * reach, 0.5 + 0.28 * reach}});
  packing.orientation.set_row(1, {0.0, 1.0});
  constexpr scarp::LinearFrictional smooth{.normal_stiffness = 6e6};
  auto stepper = undamped<Ellipses>(1e-4);
  REQUIRE(stepper.refresh(packing, smooth).acceptable());
  double const time_step = stepper.time_step_share * packing.pairs.critical_step;
  constexpr int steps = 80;
  packing.velocity(1, 0) = -0.04 * reach / (steps * time_step);
  bool along_x = false;
  bool along_y = false;
  for (int step = 0; step < steps; ++step) {
    scarp::Point<2, double> const branch{packing.position(1, 0) - packing.position(0, 0),
                                         packing.position(1, 1) - packing.position(0, 1)};
    auto const pose = [&](std::size_t grain) {
      return scarp::Ellipse::pose<double>(slender, {packing.orientation(grain, 0), packing.orientation(grain, 1)});
    };
    auto const least = scarp::minimum_translation<scarp::Ellipse>(pose(0), pose(1), branch);
    REQUIRE(least.normal_error == 0.0);
    scarp::StepObservation<2> seen{};
    REQUIRE(stepper.step<scarp::Observe::energy>(packing, smooth, Tensor<2>::Zero(), &seen).acceptable());
    double const stored = smooth.normal_stiffness * least.overlap * least.overlap / 2.0;
    CHECK(seen.stored_energy == samples::Approx(stored).epsilon(1e-6));
    (std::abs(least.normal[0]) > 0.7 ? along_x : along_y) = true;
  }
  CHECK(along_x);
  CHECK(along_y);
}

TEST_CASE("grains with dashpots rebound with the restitution of their law") {
  auto const dashpots = Damped::of({.modulus = 1e9, .poisson = 0.3}, 0.5, {.restitution = 0.6});
  auto packing = free_pair<DampedDiscs>(-1e-6);
  constexpr double speed = 0.1;
  packing.velocity(0, 0) = speed;
  packing.velocity(1, 0) = -speed;
  auto stepper = undamped<DampedDiscs>(0.02);
  for (int step = 0; packing.velocity(1, 0) < 0.0 || packing.position(1, 0) - packing.position(0, 0) < 2.0 * reach;
       ++step) {
    REQUIRE(step < 100'000);
    REQUIRE(stepper.step(packing, dashpots, Tensor<2>::Zero()).acceptable());
  }
  // Analytic: see `damping_ratio_for`. Dashpots lag by half a step, some hundred of which are in the contact.
  CHECK(packing.velocity(1, 0) == samples::Approx(0.6 * speed).epsilon(1e-2));
  CHECK(packing.velocity(0, 0) == samples::Approx(-packing.velocity(1, 0)).epsilon(1e-12));
}

TEST_CASE("the spring beside a dashpot takes each slip once") {
  auto const dashpots = Damped::of({.modulus = 1e9, .poisson = 0.3}, 0.5, {.restitution = 0.6});
  auto packing = free_pair<DampedDiscs>(1e-6);
  constexpr double speed = 1e-5;  // slips of far less than the overlap: nothing slides
  packing.velocity(1, 1) = speed;
  auto stepper = undamped<DampedDiscs>(0.05);
  REQUIRE(stepper.step(packing, dashpots, Tensor<2>::Zero()).acceptable());
  scarp::StepObservation<2> seen;
  REQUIRE(stepper.observe(packing, dashpots, seen).acceptable());
  double const present = 2.0 * reach - (packing.position(1, 0) - packing.position(0, 0));
  double const spring = dashpots.stiffness(present, reach / 2.0).tangential;
  double const shear = packing.pairs.shear(0, 0);
  // Analytic: stiffness times slip. The normal turns by 1e-8, and grains part by a hundred slips: 1e-6.
  CHECK(std::abs(shear) == samples::Approx(spring * speed * packing.last_move.duration).epsilon(1e-5));
  REQUIRE(stepper.observe(packing, dashpots, seen).acceptable());
  CHECK(packing.pairs.shear(0, 0) == shear);
}

TEST_CASE("clumps that touch with single discs push and turn each other as wholes") {
  constexpr double scale = 1e-3;
  constexpr double overlap = 1e-6;
  // The first lies along x, the second stands upright with its lower disc beside the first one's tip.
  Vector<2> const centre(0.5, 0.5);
  Vector<2> const other = centre + Vector<2>(2.75 * scale - overlap, 0.75 * scale);
  auto packing =
      place<Dumbbells>(Tensor<2>::Identity(), {{scale}, {scale}}, {centre, other}, {0.0, std::numbers::pi / 2.0});
  auto stepper = undamped<Dumbbells>(0.05);
  REQUIRE(stepper.step(packing, law, Tensor<2>::Zero()).acceptable());
  auto const& grains = *packing.population;
  double const push = law.normal_stiffness * overlap * packing.last_move.duration;
  // Analytic: k_n u along x, 0.75 of the scale below the second one's centre. Round-off of places, 1e-16 over 1e-6.
  CHECK(packing.velocity(0, 0) == samples::Approx(-push * grains.inverse_mass()[0]).epsilon(1e-9));
  CHECK(packing.velocity(1, 0) == samples::Approx(push * grains.inverse_mass()[1]).epsilon(1e-9));
  CHECK(packing.spin(1, 0) == samples::Approx(push * 0.75 * scale * grains.inverse_inertia()[1]).epsilon(1e-9));
  CHECK(std::abs(packing.spin(0, 0)) < 1e-9 * packing.spin(1, 0));
}

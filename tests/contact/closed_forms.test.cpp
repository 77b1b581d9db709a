// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "support/approx.hpp"

namespace {

using samples::relative_error;
using scarp::ContactKinematics;
using scarp::ContactLaw;
using scarp::ContactMemory;
using scarp::HertzMindlin;
using scarp::HertzRestitution;
using scarp::LinearFrictional;
using scarp::RollingResistance;

constexpr double gravity = 9.81;

/// A solid sphere that rests on a plane under its weight and moves along it. Moments of the law act on the sphere.
struct Ball {
  double mass = 2.0;
  double radius = 0.1;
  double speed = 0.0;
  double spin = 0.0;  // rolls where radius x spin = speed
  ContactMemory<2, double> memory{};

  double surface_speed() const { return speed - radius * spin; }

  /// `push` is a force along the plane [N].
  template <ContactLaw Law>
  void step(Law const& law, double overlap, double time_step, double push = 0.0) {
    double const slip = surface_speed() * time_step;
    auto const force = law.respond(ContactKinematics<2, double>{.overlap = overlap,
                                                                .slip_increment = slip,
                                                                .rotation_increment = spin * time_step,
                                                                .reduced_radius = radius,
                                                                .tangential_increment = slip,
                                                                .reduced_mass = mass,
                                                                .time_step = time_step},
                                   memory);
    speed += (force.shear + push) / mass * time_step;
    spin += (force.moment - radius * force.shear) / (0.4 * mass * radius * radius) * time_step;
  }
};

}  // namespace

TEST_CASE("a linear spring gives back all speed after half its period") {
  constexpr double mass = 0.3, stiffness = 2e6, speed = 0.7;
  double const period = std::numbers::pi * std::sqrt(mass / stiffness);  // analytic: t_c = pi sqrt(m* / k_n), e = 1
  scarp::Frictionless const law{.normal_stiffness = stiffness};
  for (int const steps : {20, 200, 2000}) {
    double const time_step = period / steps;
    ContactMemory<2, double> memory;
    double overlap = 0.0, closing_speed = speed, largest = 0.0, former = 0.0;
    int n = 0;
    for (; overlap >= 0.0; ++n) {
      former = overlap;
      overlap += closing_speed * time_step;
      closing_speed -=
          law.respond(ContactKinematics<2, double>{.overlap = overlap, .slip_increment = 0.0}, memory).normal / mass *
          time_step;
      largest = std::max(largest, overlap);
    }
    double const duration = (n - 1 + former / (former - overlap)) * time_step;
    // Leap-frog shortens the period by (pi / steps)^2 / 24; the last step leaves the contact at its constant speed, an
    // error of third order. The peak is sampled within half a step: (pi / steps)^2 / 8.
    double const error = std::pow(std::numbers::pi / steps, 2);
    CHECK(relative_error(duration, period) < error / 12.0);
    CHECK(relative_error(largest, speed * std::sqrt(mass / stiffness)) < error / 4.0);
    // The overlap of the last step, at most one step's worth, keeps its energy: (pi / steps)^2 / 2.
    CHECK(relative_error(-closing_speed, speed) < error);
  }
}

TEST_CASE("a ball that is thrown slides at mu g and rolls on with five sevenths of its speed") {
  constexpr double friction = 0.3, start = 2.0, time_step = 1e-5;
  LinearFrictional const law{.normal_stiffness = 1e7, .tangential_stiffness = 1e7, .friction = friction};
  Ball ball{.speed = start};
  double const overlap = ball.mass * gravity / law.normal_stiffness;
  double const slides = 2.0 * start / (7.0 * friction * gravity);  // analytic [s]
  int step = 0;
  for (; step * time_step < 0.99 * slides; ++step) {
    ball.step(law, overlap, time_step);
    if (step % 1000 != 999) continue;
    double const time = (step + 1) * time_step;
    // Analytic: u = u_0 - mu g t, r w = 2.5 mu g t from the first step on, whose slip is 34 times what the spring
    // takes.
    // Round-off of 10^5 steps.
    CHECK(std::abs(ball.speed - (start - friction * gravity * time)) < 1e-10 * start);
    CHECK(std::abs(ball.radius * ball.spin - 2.5 * friction * gravity * time) < 1e-10 * start);
  }
  double slowest = start, fastest = 0.0;
  for (; step * time_step < 3.0 * slides; ++step) {
    ball.step(law, overlap, time_step);
    if (step * time_step < 1.01 * slides) continue;
    slowest = std::min(slowest, ball.speed);
    fastest = std::max(fastest, ball.speed);
  }
  // Analytic: u = 5 u_0 / 7, about which the spring swings with what it held, mu N: slip speed mu N sqrt(3.5 / (k_t
  // m)), of which the centre has 2/7. Without friction's slider nothing is lost.
  double const swing =
      2.0 / 7.0 * friction * ball.mass * gravity * std::sqrt(3.5 / (law.tangential_stiffness * ball.mass));
  CHECK(std::abs((slowest + fastest) / 2.0 - 5.0 / 7.0 * start) < 0.01 * swing);
  CHECK(relative_error((fastest - slowest) / 2.0, swing) < 0.01);  // the last sliding step overshoots by its share
  // Exact: the force passes through the point of contact, about which u + 0.4 r w is kept. Round-off as above.
  CHECK(relative_error(ball.speed + 0.4 * ball.radius * ball.spin, start) < 1e-10);
}

TEST_CASE("a ball on a damped contact comes to roll without slip, whether thrown or spun") {
  constexpr double friction = 0.3, time_step = 1e-5;
  auto const law = HertzMindlin<HertzRestitution>::between(
      {.modulus = 1e7, .poisson = 0.3}, {.modulus = 1e40, .poisson = 0.3}, friction, {.restitution = 0.5});
  for (bool const thrown : {true, false}) {
    Ball ball;
    (thrown ? ball.speed : ball.spin) = thrown ? 2.0 : 20.0;
    double const overlap =
        std::pow(0.75 * ball.mass * gravity / (law.reduced_modulus * std::sqrt(ball.radius)), 2.0 / 3.0);
    for (int step = 0; step < 100'000; ++step) ball.step(law, overlap, time_step);
    // Analytic: u = 5 u_0 / 7 and w = u / r; spun, u = 2 r w_0 / 7. Damping has had hundreds of periods: round-off
    // of 10^5 steps.
    CHECK(relative_error(ball.speed, thrown ? 10.0 / 7.0 : 4.0 / 7.0) < 1e-10);
    CHECK(relative_error(ball.radius * ball.spin, ball.speed) < 1e-10);
  }
}

TEST_CASE("rolling friction slows a ball that rolls, and holds it on a slope until it is too steep") {
  constexpr double friction = 0.6, rolling_friction = 0.05, time_step = 1e-5;
  RollingResistance const law{
      LinearFrictional{.normal_stiffness = 1e7, .tangential_stiffness = 1e7, .friction = friction}, 1e6,
      rolling_friction};
  constexpr int steps = 50'000;
  for (double const slope : {0.0, 0.04, 0.06, 0.3}) {
    double const angle = std::atan(slope);
    double const pull = gravity * std::sin(angle), press = gravity * std::cos(angle);
    double const start = slope == 0.0 ? 1.0 : 0.0;
    Ball ball{.speed = start, .spin = start / 0.1};
    double const overlap = ball.mass * press / 1e7;
    for (int n = 0; n < steps; ++n) ball.step(law, overlap, time_step, ball.mass * pull);
    // Analytic: v = v_0 + 5/7 g (sin - mu_r cos) t while it rolls, at rest for tan <= mu_r.
    // 5e-3: the rolling spring takes some 1e-4 s of 0.5 s to load, and both springs go on swinging;
    // 1e-2 for the slip, of which the centre has 2/7.
    double const gained = 5.0 / 7.0 * (pull - rolling_friction * press) * steps * time_step;
    if (slope == 0.0 || slope > rolling_friction) {
      CHECK(relative_error(ball.speed - start, gained) < 5e-3);
      CHECK(relative_error(ball.radius * ball.spin, ball.speed) < 1e-2);
    } else {
      CHECK(std::abs(ball.speed) < 5e-3 * std::abs(gained));
    }
  }
}

// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <cmath>

#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "support/approx.hpp"

namespace {

using scarp::ContactKinematics;
using scarp::ContactMemory;
using scarp::Frictionless;
using scarp::LinearFrictional;
using scarp::RollingResistance;

/// Moment limit mu_r R* F_n = 0.1 x 0.5 m x 20 N = 1 N m at an overlap of 0.2 m.
constexpr RollingResistance<LinearFrictional> law{
    .law = {.normal_stiffness = 100.0, .tangential_stiffness = 50.0, .friction = 0.5},
    .rolling_stiffness = 8.0,
    .rolling_friction = 0.1};

ContactKinematics<2, double> rolled(double overlap, double roll) {
  return {.overlap = overlap, .slip_increment = 0.0, .rotation_increment = roll, .reduced_radius = 0.5};
}

static_assert(RollingResistance<LinearFrictional>::inputs.moment && RollingResistance<LinearFrictional>::inputs.shear);
static_assert(scarp::HasStoredEnergy<RollingResistance<Frictionless>>);
static_assert(!scarp::Frictional<RollingResistance<Frictionless>>, "the wrapper has no friction that its law lacks");

struct ForgetsEnergy {
  static constexpr scarp::ContactInputs inputs{};
  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(ContactKinematics<Dim, T> const&, ContactMemory<Dim, T>&) const {
    return {.normal = T(0)};
  }
  scarp::ContactStiffness stiffness(double, double) const { return {}; }
};
static_assert(scarp::ContactLaw<RollingResistance<ForgetsEnergy>>);
static_assert(!scarp::HasStoredEnergy<RollingResistance<ForgetsEnergy>>, "nor an energy that its law does not tell");

template <class Law>
concept CanResistRolling = requires {
  typename RollingResistance<Law>;
};
static_assert(CanResistRolling<scarp::HertzMindlin<>>);
static_assert(!CanResistRolling<RollingResistance<Frictionless>>, "a contact remembers one moment");

}  // namespace

TEST_CASE("rolling is resisted by a spring and forces are those of the law inside") {
  ContactMemory<2, double> memory, alone;
  auto const force = law.respond(rolled(0.2, 0.05), memory);
  CHECK(force.moment == samples::Approx(-0.4).epsilon(1e-15));  // analytic: k_r x 0.05; one rounding
  CHECK(memory.moment == force.moment);
  CHECK(force.normal == law.law.respond(rolled(0.2, 0.05), alone).normal);
  CHECK(law.stiffness(0.2, 0.5).rolling == 8.0);
  CHECK(law.stiffness(0.2, 0.5).normal == 100.0);
}

TEST_CASE("the moment ends at rolling friction times radius times normal force") {
  ContactMemory<2, double> memory;
  CHECK(law.respond(rolled(0.2, 1.0), memory).moment == samples::Approx(-1.0).epsilon(1e-15));  // analytic, see law
  CHECK(law.respond(rolled(0.2, -1.0), memory).moment == samples::Approx(1.0).epsilon(1e-15));
  CHECK(law.respond(rolled(0.1, 0.0), memory).moment == samples::Approx(0.5).epsilon(1e-15));
  CHECK(law.respond(rolled(-0.1, 0.3), memory).moment == 0.0);
}

TEST_CASE("in space the moment is limited in size and keeps its direction") {
  ContactMemory<3, double> memory;
  auto const force = law.respond(
      ContactKinematics<3, double>{
          .overlap = 0.2, .slip_increment = {}, .rotation_increment = {0.0, 0.3, 0.4}, .reduced_radius = 0.5},
      memory);
  // Analytic: the trial moment 8 x 0.5 = 4 N m lies along -(0, 0.6, 0.8), the limit is 1 N m.
  CHECK(force.moment[0] == 0.0);
  CHECK(force.moment[1] == samples::Approx(-0.6).epsilon(1e-14));
  CHECK(force.moment[2] == samples::Approx(-0.8).epsilon(1e-14));
}

TEST_CASE("a bond that is pulled resists rolling by the size of its pull") {
  using Bond = scarp::CohesiveBond<LinearFrictional>;
  RollingResistance<Bond> const rolling_bond{.law = {.law = law.law, .tensile_strength = 30.0, .shear_strength = 1.0},
                                             .rolling_stiffness = 8.0,
                                             .rolling_friction = 0.1};
  CHECK(rolling_bond.interaction_range() ==
        samples::Approx(0.3).epsilon(1e-15));  // analytic: T / k_n, told by the bond inside
  ContactMemory<2, double> memory;
  Bond::bond(memory);
  auto const force = rolling_bond.respond(rolled(-0.2, 1.0), memory);
  CHECK(force.normal == samples::Approx(-20.0).epsilon(1e-15));  // analytic: k_n u
  CHECK(force.moment == samples::Approx(-1.0).epsilon(1e-15));   // analytic: 0.1 x 0.5 m x 20 N
}

TEST_CASE("work of rolling is stored in the spring or dissipated by its slider") {
  ContactMemory<2, double> memory;
  double work = 0.0, dissipated = 0.0;
  for (double const roll : {0.05, 0.1, -0.02, 0.3, -0.4, 0.01}) {
    double const before = memory.moment;
    dissipated += law.respond(rolled(0.2, roll), memory).dissipated;
    work -= 0.5 * (before + memory.moment) * roll;
  }
  double const spring = law.stored_energy(rolled(0.2, 0.0), memory) - law.law.stored_energy(rolled(0.2, 0.0), memory);
  CHECK(spring == samples::Approx(memory.moment * memory.moment / 16.0).epsilon(1e-12));  // analytic: M^2 / 2 k_r
  CHECK(dissipated > 0.1);
  CHECK(work == samples::Approx(spring + dissipated).epsilon(1e-13));  // analytic, with mean moments; round-off
}

TEST_CASE("a sphere that spins on a smooth plane slows down at the rate of its rolling friction") {
  double const mass = 2.0, radius = 0.1, gravity = 9.81, rolling_friction = 0.05, start = 3.0, step = 1e-5;
  RollingResistance const on_plane{Frictionless{.normal_stiffness = 1e6}, 1e3, rolling_friction};
  double const overlap = mass * gravity / 1e6;  // rests under its weight
  ContactMemory<2, double> memory;
  double spin = start, dissipated = 0.0;
  double const inertia = 0.4 * mass * radius * radius;
  int const steps = 5000;
  for (int n = 0; n < steps; ++n) {
    auto const force = on_plane.respond(
        ContactKinematics<2, double>{
            .overlap = overlap, .slip_increment = 0.0, .rotation_increment = spin * step, .reduced_radius = radius},
        memory);
    spin += force.moment / inertia * step;
    dissipated += force.dissipated;
  }
  double const kinetic_loss = 0.5 * inertia * (start * start - spin * spin);
  // Analytic: omega = omega_0 - 5 mu_r g t / 2 r (test of rolling friction in LAMMPS's granular suite). The spring
  // needs 1e-4 rad to reach its limit, 3 steps of 5000: 1e-3.
  double const expected = start - 2.5 * rolling_friction * gravity * steps * step / radius;
  CHECK(spin == samples::Approx(expected).epsilon(1e-3));
  CHECK(kinetic_loss == samples::Approx(dissipated + 0.5 * memory.moment * memory.moment / 1e3).epsilon(1e-3));
}

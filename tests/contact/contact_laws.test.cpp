// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "support/approx.hpp"

namespace {

using scarp::ContactKinematics;
using scarp::ContactMemory;
using scarp::Frictionless;
using scarp::LinearFrictional;

struct LawWithoutStiffness {
  static constexpr scarp::ContactInputs inputs{};
  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(ContactKinematics<Dim, T> const&, ContactMemory<Dim, T>&) const {
    return {.normal = T(0)};
  }
};
static_assert(scarp::RespondsToApproach<LawWithoutStiffness> && !scarp::ContactLaw<LawWithoutStiffness>,
              "a law that cannot tell its stiffness must be refused");

struct LawWithTooManyNumbers : Frictionless {
  static constexpr scarp::ContactInputs inputs{.scalars = scarp::max_contact_scalars + 1};
};
static_assert(!scarp::NamesContactInputs<LawWithTooManyNumbers>, "no contact has room for that many numbers");

static_assert(!Frictionless::inputs.shear && LinearFrictional::inputs.shear);
constexpr scarp::ContactInputs nothing_asked{};
static_assert(!nothing_asked.shear && !nothing_asked.moment && nothing_asked.scalars == 0 && !nothing_asked.radius &&
                  !nothing_asked.motion,
              "a contact pays for what its law names only");
static_assert(!scarp::Frictional<Frictionless>, "there is no friction to exchange in a frictionless law");

constexpr LinearFrictional law{.normal_stiffness = 100.0, .tangential_stiffness = 50.0, .friction = 0.5};

}  // namespace

TEST_CASE("a closed contact pushes with stiffness times overlap and shears against the slip") {
  ContactMemory<2, double> memory;
  // Analytic: F_n = 100 x 0.2 = 20, F_t = -50 x 0.1 = -5, below the limit 10; exact in binary up to the decimals.
  auto const force = law.respond(ContactKinematics<2, double>{0.2, 0.1}, memory);
  CHECK(force.normal == samples::Approx(20.0).epsilon(1e-15));
  CHECK(force.shear == samples::Approx(-5.0).epsilon(1e-15));
  CHECK(memory.shear == force.shear);
  law.respond(ContactKinematics<2, double>{0.2, -0.04}, memory);
  CHECK(memory.shear == samples::Approx(-3.0).epsilon(1e-15));
}

TEST_CASE("shear is clamped at friction times normal force on both sides") {
  ContactMemory<2, double> memory;
  law.respond(ContactKinematics<2, double>{0.2, 1.0}, memory);
  CHECK(memory.shear == samples::Approx(-10.0).epsilon(1e-15));  // analytic: mu F_n = 0.5 x 20
  law.respond(ContactKinematics<2, double>{0.2, -5.0}, memory);
  CHECK(memory.shear == samples::Approx(10.0).epsilon(1e-15));
  law.respond(ContactKinematics<2, double>{0.05, 0.0}, memory);  // unloading lowers the limit to 2.5
  CHECK(memory.shear == samples::Approx(2.5).epsilon(1e-15));
}

TEST_CASE("sliding dissipates the work against the limit, sticking nothing") {
  ContactMemory<2, double> memory;
  // Decimals of a few units cancel: 1e-13.
  CHECK(std::abs(law.respond(ContactKinematics<2, double>{0.2, 0.1}, memory).dissipated) < 1e-13);
  // Analytic: from -5 to the limit -10 the spring takes 75/100 J; the mean force 7.5 over 0.5 m works 3.75 J.
  CHECK(law.respond(ContactKinematics<2, double>{0.2, 0.5}, memory).dissipated == samples::Approx(3.0).epsilon(1e-13));
  // Analytic: at the limit all work is lost, 10 N x 0.3 m.
  CHECK(law.respond(ContactKinematics<2, double>{0.2, 0.3}, memory).dissipated == samples::Approx(3.0).epsilon(1e-13));
}

TEST_CASE("an open contact carries nothing and forgets its shear") {
  ContactMemory<2, double> memory{.shear = 7.0};
  CHECK(law.respond(ContactKinematics<2, double>{-1e-9, 0.1}, memory).normal == 0.0);
  CHECK(memory.shear == 0.0);
}

TEST_CASE("in space the shear force is clamped in size and keeps its direction") {
  ContactMemory<3, double> memory;
  law.respond(ContactKinematics<3, double>{0.2, {0.3, 0.4, 0.0}}, memory);
  // Analytic: the trial force -50 (0.3, 0.4) = -(15, 20) has size 25, the limit is 10.
  CHECK(memory.shear[0] == samples::Approx(-6.0).epsilon(1e-14));
  CHECK(memory.shear[1] == samples::Approx(-8.0).epsilon(1e-14));
  CHECK(memory.shear[2] == 0.0);
  law.respond(ContactKinematics<3, double>{-0.1, {0.0, 0.0, 0.0}}, memory);
  CHECK(memory.shear[0] == 0.0);
}

TEST_CASE("a frictionless contact pushes and leaves shear alone") {
  Frictionless const smooth{.normal_stiffness = 100.0};
  ContactMemory<2, double> memory{.shear = 3.0};
  auto const force = smooth.respond(ContactKinematics<2, double>{0.2, 1.0}, memory);
  CHECK(force.normal == samples::Approx(20.0).epsilon(1e-15));  // analytic: 100 x 0.2
  CHECK(force.shear == 0.0);
  CHECK(smooth.respond(ContactKinematics<2, double>{-0.2, 1.0}, memory).normal == 0.0);
  CHECK(memory.shear == 3.0);
}

TEST_CASE("laws tell their stiffness and the energy of their springs") {
  Frictionless const smooth{.normal_stiffness = 100.0};
  CHECK(smooth.stiffness(0.1, 1.0).normal == 100.0);
  CHECK(smooth.stiffness(0.1, 1.0).tangential == 0.0);
  CHECK(law.stiffness(0.1, 1.0).tangential == 50.0);
  ContactMemory<2, double> const memory{.shear = -5.0};
  // Analytic: 100 x 0.2^2 / 2 = 2 J and 5^2 / (2 x 50) = 0.25 J; round-off of the decimals.
  CHECK(smooth.stored_energy(ContactKinematics<2, double>{0.2, 0.0}, memory) == samples::Approx(2.0).epsilon(1e-15));
  CHECK(law.stored_energy(ContactKinematics<2, double>{0.2, 0.0}, memory) == samples::Approx(2.25).epsilon(1e-15));
}

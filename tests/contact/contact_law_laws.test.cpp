// SPDX-License-Identifier: BSL-1.0
// What must hold for every contact law, written once.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "contact/every_law.hpp"
#include "scarp/contact/contact_law.hpp"
#include "scarp/simd/pack.hpp"
#include "support/approx.hpp"

namespace {

using samples::bond_if_possible;
using samples::Sample;
using scarp::ContactForce;
using scarp::ContactKinematics;
using scarp::ContactMemory;

/// Jumps across contact and gap, the same ones in every run.
struct RandomApproaches {
  std::mt19937 random{20240229};

  double spread(double size) { return std::uniform_real_distribution<double>(-size, size)(random); }

  ContactKinematics<3, double> next() {
    std::array<double, 3> const slip{spread(0.1), spread(0.1), spread(0.1)};
    return {.overlap = 0.05 + spread(0.1),
            .slip_increment = slip,
            .rotation_increment = {spread(0.5), spread(0.5), spread(0.5)},
            .reduced_radius = 1.0 + spread(0.5),
            .overlap_increment = spread(0.02),
            .tangential_increment = slip,
            .reduced_mass = 2.0 + spread(1.0),
            .time_step = 0.01};
  }
};

template <class T>
ContactKinematics<2, T> in_plane(ContactKinematics<3, double> const& a) {
  auto const number = [](double value) { return scarp::broadcast<T>(value); };
  return {.overlap = number(a.overlap),
          .slip_increment = number(a.slip_increment[0]),
          .rotation_increment = number(a.rotation_increment[2]),
          .reduced_radius = number(a.reduced_radius),
          .overlap_increment = number(a.overlap_increment),
          .tangential_increment = number(a.tangential_increment[0]),
          .reduced_mass = number(a.reduced_mass),
          .time_step = number(a.time_step)};
}

bool all_finite(ContactForce<2, float> const& force) {
  return std::isfinite(force.normal) && std::isfinite(force.shear) && std::isfinite(force.moment) &&
         std::isfinite(force.dissipated);
}

/// Round-off of a few operations on numbers of size up to `scale`, kept through a history of clamped sums.
bool close(double a, double b, double scale) { return std::abs(a - b) <= 1e-12 * scale; }

}  // namespace

TEST_CASE_TEMPLATE("an open contact without a bond has no force and forgets shear and moment", Law, EVERY_CONTACT_LAW) {
  Law const law = Sample<Law>::law();
  RandomApproaches approaches;
  for (int n = 0; n < 200; ++n) {
    ContactMemory<3, double> memory;
    auto approach = approaches.next();
    approach.overlap = std::abs(approach.overlap);
    law.respond(approach, memory);
    approach = approaches.next();
    approach.overlap = -1e-9 - std::abs(approach.overlap);
    approach.overlap_increment = -std::abs(approach.overlap_increment);
    auto const force = law.respond(approach, memory);
    CHECK(force.normal == 0.0);  // exact: every limit is zero
    CHECK(scarp::dot(force.shear, force.shear) == 0.0);
    CHECK(scarp::dot(force.moment, force.moment) == 0.0);
    CHECK(scarp::dot(memory.shear, memory.shear) == 0.0);
    CHECK(scarp::dot(memory.moment, memory.moment) == 0.0);
  }
}

TEST_CASE_TEMPLATE("a closed contact pushes and pushes harder the deeper it is", Law, EVERY_CONTACT_LAW) {
  Law const law = Sample<Law>::law();
  ContactMemory<2, double> memory;
  double former = 0.0;
  for (double overlap = 1e-12; overlap < 1.0; overlap *= 3.0) {
    double const normal =
        law.respond(ContactKinematics<2, double>{.overlap = overlap, .slip_increment = 0.0, .reduced_radius = 1.0},
                    memory)
            .normal;
    CHECK(normal > former);
    CHECK(law.stiffness(overlap, 1.0).normal > 0.0);
    former = normal;
  }
}

TEST_CASE_TEMPLATE("the stiffness is the derivative of the forces", Law, EVERY_CONTACT_LAW) {
  Law const law = Sample<Law>::law();
  double const step = 1e-5, overlap = 0.1;
  auto const push = [&](double at) {
    ContactMemory<2, double> memory;
    return law
        .respond(ContactKinematics<2, double>{.overlap = at, .slip_increment = 0.0, .reduced_radius = 1.0}, memory)
        .normal;
  };
  auto const stiffness = law.stiffness(overlap, 1.0);
  // Analytic: central difference, error step^2 F''' ~ 1e-8 and round-off 1e-10 of the stiffness.
  CHECK((push(overlap + step) - push(overlap - step)) / (2.0 * step) ==
        samples::Approx(stiffness.normal).epsilon(1e-7));
  ContactMemory<2, double> memory;
  auto const force = law.respond(
      ContactKinematics<2, double>{
          .overlap = overlap, .slip_increment = step, .rotation_increment = step, .reduced_radius = 1.0},
      memory);
  CHECK(-force.shear / step == samples::Approx(stiffness.tangential).epsilon(1e-12));  // linear in the slip; round-off
  CHECK(-force.moment / step == samples::Approx(stiffness.rolling).epsilon(1e-12));
}

TEST_CASE_TEMPLATE("without a bond shear stays inside Coulomb's limit", Law, EVERY_CONTACT_LAW) {
  if constexpr (scarp::Frictional<Law>) {
    Law law = Sample<Law>::law();
    RandomApproaches approaches;
    ContactMemory<3, double> memory;
    for (int n = 0; n < 1000; ++n) {
      friction_coefficient(law) = 0.1 * (n % 7);  // the coefficient that is exchanged is the one that acts
      auto const force = law.respond(approaches.next(), memory);
      // Analytic: mu F_n; the square root and the scaling round.
      CHECK(std::sqrt(scarp::dot(force.shear, force.shear)) <=
            friction_coefficient(law) * force.normal * (1.0 + 1e-14));
    }
  }
}

TEST_CASE_TEMPLATE("packs give lane by lane what single numbers give", Law, EVERY_CONTACT_LAW) {
  Law const law = Sample<Law>::law();
  using Lanes = scarp::lanes::Pack<double>;
  RandomApproaches approaches;
  for (int path = 0; path < 20; ++path) {
    std::array<ContactMemory<3, double>, Lanes::size()> single{};
    if (path % 2 == 1) {
      for (auto& memory : single) bond_if_possible<Law>(memory);
    }
    ContactMemory<3, Lanes> packed;
    for (std::size_t k = 0; k < packed.scalars.size(); ++k) packed.scalars[k] = single[0].scalars[k];
    for (int n = 0; n < 20; ++n) {
      std::array<ContactKinematics<3, double>, Lanes::size()> lanes;
      for (auto& lane : lanes) lane = approaches.next();
      auto const gather = [&](auto const& number_of) {
        Lanes values(0);
        for (std::size_t lane = 0; lane < lanes.size(); ++lane) values.vector[lane] = number_of(lanes[lane]);
        return values;
      };
      ContactKinematics<3, Lanes> approach{
          .overlap = gather([](auto const& a) { return a.overlap; }),
          .slip_increment = {},
          .reduced_radius = gather([](auto const& a) { return a.reduced_radius; }),
          .overlap_increment = gather([](auto const& a) { return a.overlap_increment; }),
          .reduced_mass = gather([](auto const& a) { return a.reduced_mass; }),
          .time_step = gather([](auto const& a) { return a.time_step; })};
      for (std::size_t k = 0; k < 3; ++k) {
        approach.slip_increment[k] = gather([k](auto const& a) { return a.slip_increment[k]; });
        approach.rotation_increment[k] = gather([k](auto const& a) { return a.rotation_increment[k]; });
        approach.tangential_increment[k] = approach.slip_increment[k];
      }
      auto const force = law.respond(approach, packed);
      for (std::size_t lane = 0; lane < Lanes::size(); ++lane) {
        auto const expected = law.respond(lanes[lane], single[lane]);
        bool same = close(force.normal[lane], expected.normal, 100.0) &&
                    close(force.dissipated[lane], expected.dissipated, 100.0);
        for (std::size_t k = 0; k < 3; ++k) {
          same = same && close(force.shear[k][lane], expected.shear[k], 100.0) &&
                 close(force.moment[k][lane], expected.moment[k], 100.0) &&
                 close(packed.shear[k][lane], single[lane].shear[k], 100.0);
        }
        for (std::size_t k = 0; k < packed.scalars.size(); ++k) {
          same = same && close(packed.scalars[k][lane], single[lane].scalars[k], 1.0);
        }
        CHECK(same);
      }
    }
  }
}

TEST_CASE_TEMPLATE("motion along one axis of space is motion in the plane", Law, EVERY_CONTACT_LAW) {
  Law const law = Sample<Law>::law();
  RandomApproaches approaches;
  ContactMemory<3, double> in_space;
  ContactMemory<2, double> in_the_plane;
  for (int n = 0; n < 200; ++n) {
    auto approach = approaches.next();
    approach.slip_increment = approach.tangential_increment = {approach.slip_increment[0], 0.0, 0.0};
    approach.rotation_increment = {0.0, 0.0, approach.rotation_increment[2]};
    auto const force = law.respond(approach, in_space);
    auto const expected = law.respond(in_plane<double>(approach), in_the_plane);
    CHECK(close(force.normal, expected.normal, 100.0));
    CHECK(close(force.shear[0], expected.shear, 100.0));
    CHECK(close(force.moment[2], expected.moment, 100.0));
    CHECK(close(force.dissipated, expected.dissipated, 100.0));
    CHECK(force.shear[1] == 0.0);
    CHECK(force.shear[2] == 0.0);
    CHECK(force.moment[0] == 0.0);
    CHECK(force.moment[1] == 0.0);
  }
}

TEST_CASE_TEMPLATE("single precision stays finite, at rest, at first touch and far apart too", Law, EVERY_CONTACT_LAW) {
  Law const law = Sample<Law>::law();
  RandomApproaches approaches;
  ContactMemory<2, float> memory;
  for (int n = 0; n < 500; ++n) {
    auto approach = in_plane<float>(approaches.next());
    if (n % 5 == 0) approach.overlap = 0.0f;
    if (n % 7 == 0) approach.overlap = 1e-20f;
    if (n % 11 == 0) approach.overlap = -1e3f;
    if (n % 13 == 0)
      approach.time_step = approach.overlap_increment = approach.slip_increment = approach.tangential_increment = 0.0f;
    CHECK(all_finite(law.respond(approach, memory)));
  }
}

TEST_CASE_TEMPLATE("not a number goes in and comes out", Law, EVERY_CONTACT_LAW) {
  Law const law = Sample<Law>::law();
  double const nan = std::numeric_limits<double>::quiet_NaN();
  ContactKinematics<2, double> const sound{.overlap = 0.1,
                                           .slip_increment = 0.01,
                                           .rotation_increment = 0.01,
                                           .reduced_radius = 1.0,
                                           .reduced_mass = 1.0,
                                           .time_step = 0.01};
  auto const after = [&](ContactKinematics<2, double> const& approach) {
    ContactMemory<2, double> memory;
    return law.respond(approach, memory);
  };
  auto approach = sound;
  approach.overlap = nan;
  CHECK(std::isnan(after(approach).normal));
  approach = sound;
  approach.slip_increment = nan;
  if (Law::inputs.shear) CHECK(std::isnan(after(approach).shear));
  approach = sound;
  approach.rotation_increment = nan;
  if (Law::inputs.moment) CHECK(std::isnan(after(approach).moment));
  approach = sound;
  approach.overlap_increment = nan;
  if (Law::inputs.motion) CHECK(std::isnan(after(approach).normal));
}

TEST_CASE_TEMPLATE("work is stored or dissipated", Law, EVERY_CONTACT_LAW) {
  Law const law = Sample<Law>::law();
  // Presses, slips and rolls along a smooth path with sticking and sliding; the pressing oscillates in the contact.
  auto const gap_in_the_balance = [&](int steps) {
    ContactMemory<2, double> memory;
    double work = 0.0, dissipated = 0.0, time = 0.0;
    double const step = 10.0 / steps;
    auto const overlap = [](double t) { return 0.05 * (1.0 - std::cos(t)) + 0.02; };
    auto const slip = [](double t) { return 0.3 * std::sin(1.7 * t); };
    auto const roll = [](double t) { return 0.9 * std::sin(1.3 * t); };
    ContactKinematics<2, double> approach{
        .overlap = overlap(0.0), .slip_increment = 0.0, .reduced_radius = 1.0, .reduced_mass = 1.0};
    auto before = law.respond(approach, memory);
    double const start = law.stored_energy(approach, memory);
    approach.time_step = step;
    for (int n = 0; n < steps; ++n, time += step) {
      approach.overlap = overlap(time + step);
      approach.overlap_increment = overlap(time + step) - overlap(time);
      approach.slip_increment = approach.tangential_increment = slip(time + step) - slip(time);
      approach.rotation_increment = roll(time + step) - roll(time);
      auto const force = law.respond(approach, memory);
      work += 0.5 * (before.normal + force.normal) * approach.overlap_increment -
              0.5 * (before.shear + force.shear) * approach.slip_increment -
              0.5 * (before.moment + force.moment) * approach.rotation_increment;
      dissipated += force.dissipated;
      before = force;
    }
    double const stored = law.stored_energy(approach, memory) - start;
    return std::abs(work - stored - dissipated) / (std::abs(stored) + std::abs(dissipated));
  };
  // Analytic: 0. Curved springs err to second order in a step of 1e-3 of the time scale, dashpots to first.
  CHECK(gap_in_the_balance(10000) < (Law::inputs.motion ? 1e-4 : 1e-8));
}

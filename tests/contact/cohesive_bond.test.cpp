// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "support/approx.hpp"

namespace {

using scarp::ContactKinematics;
using scarp::ContactMemory;
using scarp::LinearFrictional;
using Bond = scarp::CohesiveBond<LinearFrictional>;
using Memory = ContactMemory<2, double>;

constexpr Bond law{.law = {.normal_stiffness = 100.0, .tangential_stiffness = 50.0, .friction = 0.5},
                   .tensile_strength = 10.0,
                   .shear_strength = 8.0};

static_assert(Bond::inputs.shear && Bond::inputs.scalars == 1);

template <class Law>
concept CanBeBonded = requires {
  typename scarp::CohesiveBond<Law>;
};
static_assert(CanBeBonded<LinearFrictional>);
static_assert(!CanBeBonded<scarp::HertzMindlin<>>, "a Hertz contact has no stiffness left to pull with");
static_assert(!CanBeBonded<scarp::Frictionless>, "nor has a frictionless one a spring to shear");

Memory bonded() {
  Memory memory;
  Bond::bond(memory);
  return memory;
}

}  // namespace

TEST_CASE("a bond pulls up to its tensile strength and then breaks for good") {
  Memory memory = bonded();
  CHECK(law.interaction_range() == samples::Approx(0.1).epsilon(1e-15));  // analytic: T / k_n; one rounding
  CHECK(law.respond(ContactKinematics<2, double>{-0.09, 0.0}, memory).normal == samples::Approx(-9.0).epsilon(1e-15));
  CHECK(Bond::is_intact(memory));
  CHECK(law.respond(ContactKinematics<2, double>{-0.11, 0.0}, memory).normal == 0.0);
  CHECK(Bond::is_broken(memory));
  law.respond(ContactKinematics<2, double>{0.1, 0.0}, memory);  // touches again
  CHECK(law.respond(ContactKinematics<2, double>{-0.01, 0.0}, memory).normal == 0.0);
  CHECK(Bond::is_broken(memory));
}

TEST_CASE("a bond carries shear up to cohesion and friction and then slides at friction alone") {
  // Analytic: C + mu k_n u = 8 + 0.5 x 100 u.
  for (double const overlap : {-0.05, 0.0, 0.2}) {
    double const strength = 8.0 + 50.0 * overlap;
    Memory memory = bonded();
    CHECK(law.respond(ContactKinematics<2, double>{overlap, 0.99 * strength / 50.0}, memory).shear ==
          samples::Approx(-0.99 * strength).epsilon(1e-14));
    CHECK(Bond::is_intact(memory));
    auto const force = law.respond(ContactKinematics<2, double>{overlap, 0.02 * strength / 50.0}, memory);
    CHECK(Bond::is_broken(memory));
    CHECK(force.shear == samples::Approx(-std::max(50.0 * overlap, 0.0)).epsilon(1e-14));
    CHECK(force.normal == samples::Approx(std::max(100.0 * overlap, 0.0)).epsilon(1e-14));
  }
}

TEST_CASE("in space the shear strength bounds the size of the shear force") {
  ContactMemory<3, double> memory;
  Bond::bond(memory);
  // Analytic: sizes 50 x (0.15, 0.165) = (7.5, 8.25) around C = 8.
  auto const force = law.respond(ContactKinematics<3, double>{0.0, {0.09, 0.12, 0.0}}, memory);
  CHECK(force.shear[0] == samples::Approx(-4.5).epsilon(1e-14));
  CHECK(force.shear[1] == samples::Approx(-6.0).epsilon(1e-14));
  law.respond(ContactKinematics<3, double>{0.0, {0.009, 0.012, 0.0}}, memory);
  CHECK(Bond::is_broken(memory));
  CHECK(memory.shear[0] == 0.0);
}

TEST_CASE("breakages can be counted") {
  std::vector<Memory> contacts(10, bonded());
  contacts.emplace_back();  // never bonded
  double gap = 0.0;
  for (Memory& memory : contacts) law.respond(ContactKinematics<2, double>{-(gap += 0.02), 0.0}, memory);
  int broken = 0, intact = 0;
  for (Memory const& memory : contacts) {
    broken += Bond::is_broken(memory);
    intact += Bond::is_intact(memory);
  }
  // Analytic: gaps of 0.02 to 0.2 m; those of 0.02 to 0.08 m surely lie below T / k_n = 0.1 m, 0.1 m itself by
  // round-off.
  CHECK(broken + intact == 10);
  CHECK(intact >= 4);
  CHECK(intact <= 5);
}

TEST_CASE("a contact that was never bonded answers bit by bit as the law inside, and so does a broken one") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  Memory base, unbonded, broken = bonded();
  law.respond(ContactKinematics<2, double>{-1.0, 0.0}, broken);
  for (int n = 0; n < 1000; ++n) {
    ContactKinematics<2, double> const approach{0.1 + spread(random), spread(random)};
    auto const expected = law.law.respond(approach, base);
    for (Memory* memory : {&unbonded, &broken}) {
      auto const force = law.respond(approach, *memory);
      CHECK(force.normal == expected.normal);
      CHECK(force.shear == expected.shear);
      CHECK(force.dissipated == expected.dissipated);
    }
  }
  CHECK(!Bond::is_intact(unbonded));
  CHECK(!Bond::is_broken(unbonded));
}

TEST_CASE("an intact bond stores all work and a broken one has dissipated what the law cannot keep") {
  // Pulled and sheared in many steps until it breaks, with mean forces as the work of a step.
  struct Path {
    double overlap, slip;  // at the end
  };
  for (Path const& path : {Path{-0.15, 0.02}, Path{-0.02, 0.3}, Path{0.1, 0.5}}) {
    int const steps = 20000;
    int while_intact = 0;
    Memory memory = bonded();
    double work = 0.0, dissipated = 0.0, overlap = 0.0;
    scarp::ContactForce<2, double> before{.normal = 0.0}, force{.normal = 0.0};
    for (int n = 1; n <= steps; ++n) {
      double const closing = path.overlap / steps, slip = path.slip / steps;
      overlap += closing;
      before = force;
      force = law.respond(ContactKinematics<2, double>{overlap, slip}, memory);
      work += 0.5 * (before.normal + force.normal) * closing - 0.5 * (before.shear + force.shear) * slip;
      dissipated += force.dissipated;
      // Analytic: springs only; round-off of the sums.
      if (Bond::is_intact(memory)) {
        ++while_intact;
        CHECK(std::abs(dissipated) < 1e-12);
      }
    }
    CHECK(while_intact > steps / 10);
    CHECK(Bond::is_broken(memory));
    double const stored = law.stored_energy(ContactKinematics<2, double>{overlap, 0.0}, memory);
    // First order in the one step of breaking: some 1e-4 of the bond's energy.
    CHECK(work == samples::Approx(stored + dissipated).epsilon(3e-4));
  }
  Memory memory = bonded();
  law.respond(ContactKinematics<2, double>{-0.05, 0.02}, memory);
  // Analytic: 100 x 0.05^2 / 2 + 1^2 / (2 x 50); round-off.
  CHECK(law.stored_energy(ContactKinematics<2, double>{-0.05, 0.0}, memory) == samples::Approx(0.135).epsilon(1e-14));
}

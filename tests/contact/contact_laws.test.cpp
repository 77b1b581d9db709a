// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/core/pack.hpp"

namespace {

using scarp::Approach;
using scarp::Frictionless;
using scarp::LinearFrictional;

struct LawWithoutStiffness {
  static constexpr bool remembers_shear = false;
  double respond(Approach<2, double> const&, double&) const { return 0.0; }
};
static_assert(!LawWithoutStiffness::remembers_shear && !scarp::ContactLaw<LawWithoutStiffness>,
              "a law that cannot tell its stiffness must be refused");
static_assert(!Frictionless::remembers_shear && LinearFrictional::remembers_shear);
static_assert(!scarp::Frictional<Frictionless>, "there is no friction to exchange in a frictionless law");

constexpr LinearFrictional law{.normal_stiffness = 100.0, .tangential_stiffness = 50.0, .friction = 0.5};

}  // namespace

TEST_CASE("a closed contact pushes with stiffness times overlap and shears against the slip") {
  double shear = 0.0;
  // Analytic: F_n = 100 x 0.2 = 20, F_t = -50 x 0.1 = -5, below the limit 10; exact in binary up to the decimals.
  CHECK(law.respond(Approach<2, double>{0.2, 0.1}, shear) == doctest::Approx(20.0).epsilon(1e-15));
  CHECK(shear == doctest::Approx(-5.0).epsilon(1e-15));
  law.respond(Approach<2, double>{0.2, -0.04}, shear);
  CHECK(shear == doctest::Approx(-3.0).epsilon(1e-15));
}

TEST_CASE("shear is clamped at friction times normal force on both sides") {
  double shear = 0.0;
  law.respond(Approach<2, double>{0.2, 1.0}, shear);
  CHECK(shear == doctest::Approx(-10.0).epsilon(1e-15));  // analytic: mu F_n = 0.5 x 20
  law.respond(Approach<2, double>{0.2, -5.0}, shear);
  CHECK(shear == doctest::Approx(10.0).epsilon(1e-15));
  law.respond(Approach<2, double>{0.05, 0.0}, shear);  // unloading lowers the limit to 2.5
  CHECK(shear == doctest::Approx(2.5).epsilon(1e-15));
}

TEST_CASE("an open contact carries nothing and forgets its shear") {
  double shear = 7.0;
  CHECK(law.respond(Approach<2, double>{-1e-9, 0.1}, shear) == 0.0);
  CHECK(shear == 0.0);
}

TEST_CASE("in space the shear force is clamped in size and keeps its direction") {
  std::array<double, 3> shear{};
  law.respond(Approach<3, double>{0.2, {0.3, 0.4, 0.0}}, shear);
  // Analytic: the trial force -50 (0.3, 0.4) = -(15, 20) has size 25, the limit is 10.
  CHECK(shear[0] == doctest::Approx(-6.0).epsilon(1e-14));
  CHECK(shear[1] == doctest::Approx(-8.0).epsilon(1e-14));
  CHECK(shear[2] == 0.0);
  law.respond(Approach<3, double>{-0.1, {0.0, 0.0, 0.0}}, shear);
  CHECK(shear[0] == 0.0);
}

TEST_CASE("a frictionless contact pushes and leaves shear alone") {
  Frictionless const smooth{.normal_stiffness = 100.0};
  double shear = 3.0;
  CHECK(smooth.respond(Approach<2, double>{0.2, 1.0}, shear) == doctest::Approx(20.0).epsilon(1e-15));
  CHECK(smooth.respond(Approach<2, double>{-0.2, 1.0}, shear) == 0.0);
  CHECK(shear == 3.0);
  CHECK(smooth.stiffness(0.1).tangential == 0.0);
  CHECK(law.stiffness(0.1).tangential == 50.0);
}

TEST_CASE("packs of lanes give lane by lane what single numbers give") {
  using Lanes = scarp::Pack<double>;
  auto const value = [](std::size_t lane, double scale) { return scale * (static_cast<double>(lane) - 1.3); };
  Lanes const overlap([&](auto lane) { return value(lane, 0.1); });
  Lanes const slip([&](auto lane) { return value(lane, -0.7); });
  Lanes shear(2.0);
  Lanes const push = law.respond(Approach<2, Lanes>{overlap, slip}, shear);
  for (std::size_t lane = 0; lane < Lanes::size(); ++lane) {
    double single = 2.0;
    double const normal = law.respond(Approach<2, double>{value(lane, 0.1), value(lane, -0.7)}, single);
    double const lane_push = push[lane];
    double const lane_shear = shear[lane];
    CHECK(lane_push == doctest::Approx(normal).epsilon(1e-15));  // the compiler may fuse one of the two
    CHECK(lane_shear == doctest::Approx(single).epsilon(1e-15));
  }
}

TEST_CASE("not a number goes in and comes out") {
  double shear = 0.0;
  CHECK(std::isnan(law.respond(Approach<2, double>{std::nan(""), 0.0}, shear)));
  shear = 0.0;
  law.respond(Approach<2, double>{0.2, std::nan("")}, shear);
  CHECK(std::isnan(shear));
}

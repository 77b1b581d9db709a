// SPDX-License-Identifier: BSL-1.0
#include "scarp/contact/law_checks.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "contact/every_law.hpp"
#include "scarp/simd/select.hpp"
#include "support/refusals.hpp"

namespace {

/// Forces beyond a spring: across gaps up to `reach` [m], and against sliding.
struct Oily {
  static constexpr scarp::ContactInputs inputs{.shear = true, .motion = true};
  double normal_stiffness = 1e6;
  double drag = 0.0;   ///< [N s/m]
  double range = 0.0;  ///< that it tells [m]
  double reach = 0.0;

  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                      scarp::ContactMemory<Dim, T>&) const {
    T const near =
        scarp::lanes::select(approach.overlap > scarp::broadcast<T>(-reach), approach.overlap, scarp::broadcast<T>(0));
    return {.normal = scarp::broadcast<T>(normal_stiffness) * near,
            .shear = scarp::scaled(approach.tangential_increment, -scarp::broadcast<T>(drag) / approach.time_step)};
  }
  scarp::ContactStiffness stiffness(double, double) const {
    return {.normal = normal_stiffness, .tangential = normal_stiffness};
  }
  double interaction_range() const { return range; }
};

template <class Law>
concept Rubs = requires(Law& law) {
  scarp::friction_coefficient(law);
};

/// Rubs, but forgets to say that it needs shear; it has no `friction`, by which the concept would notice.
struct ForgetsShear : scarp::Frictionless {
  scarp::ContactStiffness stiffness(double, double) const { return {.normal = normal_stiffness, .tangential = 1e6}; }
};

struct ForgetsMoment : scarp::Frictionless {
  scarp::ContactStiffness stiffness(double, double) const { return {.normal = normal_stiffness, .rolling = 1e2}; }
};

/// Presses harder where grains are larger.
struct ForgetsRadius : scarp::Frictionless {
  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                      scarp::ContactMemory<Dim, T>&) const {
    return {.normal = scarp::broadcast<T>(1e9) * approach.reduced_radius * approach.overlap};
  }
};

/// Remembers its largest overlap.
struct ForgetsScalar : scarp::Frictionless {
  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                      scarp::ContactMemory<Dim, T>& memory) const {
    memory.scalars[0] = scarp::lanes::at_least(memory.scalars[0], approach.overlap);
    T const closed = scarp::lanes::at_least(approach.overlap, scarp::broadcast<T>(0));
    return {.normal = scarp::broadcast<T>(normal_stiffness) * closed};
  }
};
/// Bonds contacts by a number that it does not name.
struct ForgetsBond : scarp::Frictionless {
  template <int Dim, class T>
  static constexpr void bond(scarp::ContactMemory<Dim, T>& memory) {
    memory.scalars[0] = scarp::broadcast<T>(1.0);
  }
};
/// Adds up its slip.
struct ForgetsSlip : scarp::Frictionless {
  static constexpr scarp::ContactInputs inputs{.shear = true};
  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                      scarp::ContactMemory<Dim, T>& memory) const {
    if constexpr (Dim == 2) memory.scalars[1] = memory.scalars[1] + approach.slip_increment;
    return {.normal = scarp::broadcast<T>(normal_stiffness) *
                      scarp::lanes::at_least(approach.overlap, scarp::broadcast<T>(0))};
  }
};
/// Has no number for its force.
struct NoNumber : scarp::Frictionless {
  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                      scarp::ContactMemory<Dim, T>&) const {
    T const nothing = approach.overlap - approach.overlap;
    return {.normal = nothing / nothing};
  }
};
struct KeepsScalar : ForgetsScalar {
  static constexpr scarp::ContactInputs inputs{.scalars = 1};
};

/// Pulls across gaps up to `gap` [m], which the member of the misspelt name is to tell.
struct Sticky {
  static constexpr scarp::ContactInputs inputs{};
  double normal_stiffness = 1e6;
  double gap = 1e-4;

  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                      scarp::ContactMemory<Dim, T>&) const {
    using scarp::broadcast;
    T const force = broadcast<T>(normal_stiffness) * approach.overlap;
    return {.normal = scarp::lanes::select(approach.overlap > broadcast<T>(-gap), force, broadcast<T>(0))};
  }
  scarp::ContactStiffness stiffness(double, double) const { return {.normal = normal_stiffness}; }
  double raech() const { return gap; }
};
struct StickySpeltRight : Sticky {
  double interaction_range() const { return gap; }
};

/// Has a dashpot; the member of the misspelt name is to tell how strong it is.
struct Damped : scarp::Frictionless {
  static constexpr scarp::ContactInputs inputs{.motion = true};
  double damping = 0.2;

  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                      scarp::ContactMemory<Dim, T>&) const {
    T const rate = approach.overlap_increment / (approach.time_step + scarp::broadcast<T>(1e-12));
    T const closed = scarp::lanes::at_least(approach.overlap, scarp::broadcast<T>(0));
    return {.normal = scarp::broadcast<T>(normal_stiffness) * closed + scarp::broadcast<T>(damping) * rate};
  }
  double dampingratio() const { return damping; }
};
struct DampedSpeltRight : Damped {
  double damping_ratio() const { return damping; }
};

/// Its dashpot divides by the time step.
struct DividesByTime : scarp::Frictionless {
  static constexpr scarp::ContactInputs inputs{.motion = true};

  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                      scarp::ContactMemory<Dim, T>&) const {
    auto const closed = approach.overlap > scarp::broadcast<T>(0);
    T const push = scarp::broadcast<T>(normal_stiffness) * approach.overlap +
                   scarp::broadcast<T>(10.0) * approach.overlap_increment / approach.time_step;
    // An open contact has no force, but what is not finite stays.
    return {.normal = push * scarp::lanes::select(closed, scarp::broadcast<T>(1), scarp::broadcast<T>(0))};
  }
  double damping_ratio() const { return 0.1; }
};

static_assert(scarp::ContactLaw<Sticky> && !scarp::HasInteractionRange<Sticky> &&
              scarp::HasInteractionRange<StickySpeltRight>);

struct RubsWithoutShear : scarp::LinearFrictional {
  static constexpr scarp::ContactInputs inputs{};
};
static_assert(!scarp::ContactLaw<RubsWithoutShear>, "a law with friction that remembers no shear would not rub");

struct AnswersOneContact : scarp::Frictionless {
  scarp::ContactForce<2, double> respond(scarp::ContactKinematics<2, double> const&,
                                         scarp::ContactMemory<2, double>&) const {
    return {.normal = 0.0};
  }
};
static_assert(scarp::RespondsToApproach<AnswersOneContact> && !scarp::ContactLaw<AnswersOneContact>,
              "a law that cannot take packs must be refused");

constexpr double radius = 5e-3;

}  // namespace

TEST_CASE("the friction of a law is found within laws of a program that wrap laws of a program") {
  struct Coated {
    scarp::LinearFrictional law;
  };
  struct Wet {
    Coated law;
    double friction = 0.7;  // the outer one counts
  };
  struct Outer {
    Coated law;
  };
  Outer outer{{{.friction = 0.3}}};
  CHECK(&scarp::friction_coefficient(outer) == &outer.law.law.friction);
  Wet wet{{{.friction = 0.3}}};
  CHECK(&scarp::friction_coefficient(wet) == &wet.friction);
  struct Smooth {
    scarp::Frictionless law;
  };
  CHECK_FALSE(Rubs<Smooth>);
  CHECK(Rubs<Outer>);
}

TEST_CASE("a law that tells a stiffness without the need for its motion is refused") {
  CHECK_THROWS_WITH_AS(scarp::require_consistent(ForgetsShear{{1e6}}, radius), doctest::Contains(".shear = true"),
                       scarp::InputError);
  CHECK_THROWS_WITH_AS(scarp::require_consistent(ForgetsMoment{{1e6}}, radius), doctest::Contains(".moment = true"),
                       scarp::InputError);
}

TEST_CASE("a law names what it uses of the contact and keeps") {
  CHECK_THROWS_WITH_AS(scarp::require_consistent(ForgetsRadius{{1e6}}, radius), doctest::Contains(".radius = true"),
                       scarp::InputError);
  CHECK_THROWS_WITH_AS(scarp::require_consistent(ForgetsScalar{{1e6}}, radius), doctest::Contains(".scalars = 0"),
                       scarp::InputError);
  CHECK_REFUSED(scarp::require_consistent(ForgetsBond{{1e6}}, radius), "writes the scalar 0");
  CHECK_REFUSED(scarp::require_consistent(ForgetsSlip{{1e6}}, radius), "writes the scalar 1");
  CHECK_REFUSED(scarp::require_consistent(NoNumber{{1e6}}, radius), "a number is expected");
  CHECK_NOTHROW(scarp::require_consistent(KeepsScalar{{{1e6}}}, radius));
}

TEST_CASE("a law that pulls across a gap must tell how far") {
  CHECK_THROWS_WITH_AS(scarp::require_consistent(Sticky{}, radius), doctest::Contains("interaction_range()"),
                       scarp::InputError);
  CHECK_NOTHROW(scarp::require_consistent(StickySpeltRight{}, radius));
}

TEST_CASE("a law with a dashpot must tell its damping ratio, which shortens the time step") {
  CHECK_THROWS_WITH_AS(scarp::require_consistent(Damped{{1e6}}, radius), doctest::Contains("damping_ratio()"),
                       scarp::InputError);
  CHECK_NOTHROW(scarp::require_consistent(DampedSpeltRight{{{1e6}}}, radius));
  CHECK_NOTHROW(scarp::require_consistent(DividesByTime{{1e6}}, radius));
  // A law that is wrapped has the damping ratio of the one inside.
  CHECK_THROWS_WITH_AS(scarp::require_consistent(scarp::RollingResistance<Damped>{Damped{{1e6}}, 1.0, 0.1}, radius),
                       doctest::Contains("damping_ratio()"), scarp::InputError);
}

TEST_CASE_TEMPLATE("every law of the library is consistent", Law, EVERY_CONTACT_LAW) {
  CHECK_NOTHROW(scarp::require_consistent(samples::Sample<Law>::law(), 1.0));
}

TEST_CASE("parameters of laws that mean no contact are refused by name") {
  using scarp::HertzMindlin;
  using scarp::HertzRestitution;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  auto const refused = [](auto const& law, char const* named) {
    CAPTURE(named);
    CHECK_THROWS_WITH_AS(scarp::require_consistent(law, 1.0), doctest::Contains(named), scarp::InputError);
  };
  refused(scarp::Frictionless{}, "normal stiffness of the contact law is 0");
  refused(scarp::Frictionless{.normal_stiffness = inf}, "normal stiffness of the contact law is inf");
  auto const linear = samples::Sample<scarp::LinearFrictional>::law();
  auto negative = linear;
  negative.tangential_stiffness = -1.0;
  refused(negative, "tangential stiffness of the contact law is -1");
  auto rough = linear;
  rough.friction = nan;
  refused(rough, "friction of the contact law is nan");
  refused(HertzMindlin<>{.reduced_modulus = -1e9}, "reduced modulus of the contact law is -");
  refused(HertzMindlin<>::of({.modulus = 1e9, .poisson = 0.2}, -0.5), "friction of the contact law is -0.5");
  refused(HertzMindlin<HertzRestitution>::of({.modulus = 1e9, .poisson = 0.2}, 0.5, {.restitution = 0.0}),
          "restitution of the contact law is 0");
  refused(HertzMindlin<HertzRestitution>::of({.modulus = 1e9, .poisson = 0.2}, 0.5, {.restitution = 1.5}),
          "restitution of the contact law is 1.5");
  refused(HertzMindlin<HertzRestitution>::of({.modulus = 1e9, .poisson = 0.2}, 0.5, {.restitution = nan}),
          "restitution of the contact law is nan");
  refused(scarp::RollingResistance<scarp::LinearFrictional>{linear, -1.0, 0.1}, "rolling stiffness");
  refused(scarp::RollingResistance<scarp::LinearFrictional>{linear, 1.0, nan}, "rolling friction");
  refused(scarp::RollingResistance<scarp::LinearFrictional>{rough, 1.0, 0.1}, "friction of the contact law is nan");
  refused(scarp::CohesiveBond<scarp::LinearFrictional>{rough, 1.0, 0.1}, "friction of the contact law is nan");
  CHECK_NOTHROW(scarp::require_consistent(scarp::CohesiveBond<scarp::LinearFrictional>{linear, 1.0, inf}, 1.0));
}

TEST_CASE("a dashpot along the tangent alone, and a force beyond the range that the law tells, are rejected") {
  CHECK_NOTHROW(scarp::require_consistent(Oily{}, 5e-3));
  CHECK_REFUSED(scarp::require_consistent(Oily{.drag = 1.0}, 5e-3), "closes or slides", "damping_ratio()");
  CHECK_NOTHROW(scarp::require_consistent(Oily{.range = 2e-3, .reach = 2e-3}, 5e-3));
  CHECK_REFUSED(scarp::require_consistent(Oily{.range = 1e-6, .reach = 2e-3}, 5e-3), "across a gap of 1.005e-06 m",
                "interaction_range() is 1e-06 m");
}

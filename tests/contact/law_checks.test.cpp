// SPDX-License-Identifier: BSL-1.0
#include "scarp/contact/law_checks.hpp"

#include <doctest/doctest.h>

#include "contact/every_law.hpp"
#include "scarp/core/select.hpp"

namespace {

/// Rubs, but forgets to say that it needs shear; it has no friction_coefficient(), by which the concept would notice.
struct ForgetsShear : scarp::Frictionless {
  scarp::ContactStiffness stiffness(double, double) const { return {.normal = normal_stiffness, .tangential = 1e6}; }
};

struct ForgetsMoment : scarp::Frictionless {
  scarp::ContactStiffness stiffness(double, double) const { return {.normal = normal_stiffness, .rolling = 1e2}; }
};

/// Pulls across gaps up to `gap` [m], which the member of the misspelt name is to tell.
struct Sticky {
  static constexpr scarp::ContactNeeds needs{};
  double normal_stiffness = 1e6;
  double gap = 1e-4;

  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::Approach<Dim, T> const& approach, scarp::ContactMemory<Dim, T>&) const {
    using scarp::constant;
    T const force = constant<T>(normal_stiffness) * approach.overlap;
    return {.normal = scarp::lanes::select(approach.overlap > constant<T>(-gap), force, constant<T>(0))};
  }
  scarp::ContactStiffness stiffness(double, double) const { return {.normal = normal_stiffness}; }
  double raech() const { return gap; }
};
struct StickySpeltRight : Sticky {
  double reach() const { return gap; }
};

/// Has a dashpot; the member of the misspelt name is to tell how strong it is.
struct Damped : scarp::Frictionless {
  static constexpr scarp::ContactNeeds needs{.motion = true};
  double damping = 0.2;

  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::Approach<Dim, T> const& approach, scarp::ContactMemory<Dim, T>&) const {
    T const rate = approach.closing / (approach.time_step + scarp::constant<T>(1e-12));
    return {.normal = scarp::constant<T>(normal_stiffness) * approach.overlap + scarp::constant<T>(damping) * rate};
  }
  double dampingratio() const { return damping; }
};
struct DampedSpeltRight : Damped {
  double damping_ratio() const { return damping; }
};

static_assert(scarp::ContactLaw<Sticky> && !scarp::TellsReach<Sticky> && scarp::TellsReach<StickySpeltRight>);

struct RubsWithoutShear : scarp::LinearFrictional {
  static constexpr scarp::ContactNeeds needs{};
};
static_assert(!scarp::ContactLaw<RubsWithoutShear>, "a law with friction that remembers no shear would not rub");

struct AnswersOneContact : scarp::Frictionless {
  scarp::ContactForce<2, double> respond(scarp::Approach<2, double> const&, scarp::ContactMemory<2, double>&) const {
    return {.normal = 0.0};
  }
};
static_assert(scarp::RespondsToApproach<AnswersOneContact> && !scarp::ContactLaw<AnswersOneContact>,
              "a law that cannot take packs must be refused");

constexpr double radius = 5e-3;

}  // namespace

TEST_CASE("a law that tells a stiffness without the need for its motion is refused") {
  CHECK_THROWS_WITH_AS(scarp::require_consistent(ForgetsShear{}, radius), doctest::Contains(".shear = true"),
                       scarp::InputError);
  CHECK_THROWS_WITH_AS(scarp::require_consistent(ForgetsMoment{}, radius), doctest::Contains(".moment = true"),
                       scarp::InputError);
}

TEST_CASE("a law that pulls across a gap must tell how far") {
  CHECK_THROWS_WITH_AS(scarp::require_consistent(Sticky{}, radius), doctest::Contains("reach()"), scarp::InputError);
  CHECK_NOTHROW(scarp::require_consistent(StickySpeltRight{}, radius));
}

TEST_CASE("a law with a dashpot must tell its damping ratio, which shortens the time step") {
  CHECK_THROWS_WITH_AS(scarp::require_consistent(Damped{}, radius), doctest::Contains("damping_ratio()"),
                       scarp::InputError);
  CHECK_NOTHROW(scarp::require_consistent(DampedSpeltRight{}, radius));
}

TEST_CASE_TEMPLATE("every law of the library is consistent", Law, EVERY_CONTACT_LAW) {
  CHECK_NOTHROW(scarp::require_consistent(samples::Sample<Law>::law(), 1.0));
}

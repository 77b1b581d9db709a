// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/lazy.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scarp/constitutive/linear_elastic.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Gradient;
using scarp::VoigtStress;
using scarp::VoigtTangent;

/// Follows its path whatever the steps: stiffer along x than along y and softening with strain, so that a tangent
/// is wrong, and known to be.
struct Softening {
  static constexpr int dim = 2;
  using Plan = int;

  struct State {
    Gradient<2> gradient = Gradient<2>::Zero();  ///< since the start
    VoigtStress<2> stress{-1e5, -1e5, 0.0};
    int asked = 0;
  };

  static VoigtTangent<2> stiffness() { return Eigen::Vector3d(40e6, 20e6, 10e6).asDiagonal(); }

  State initial_state(scarp::Site<2> const&) const { return {}; }
  VoigtStress<2> stress(State const& state) const { return state.stress; }
  VoigtTangent<2> tangent(State const&) const { return stiffness(); }
  int plan(State const&, Gradient<2> const&) const { return 20; }
  int refined(int steps) const { return 2 * steps; }
  scarp::Response<2> respond(State const& committed, Gradient<2> const& increment, State& trial) const {
    trial.asked = committed.asked + 1;
    trial.gradient = committed.gradient + increment + increment * committed.gradient;
    scarp::RotatedIncrement<2> const moved(trial.gradient);
    auto const strain = scarp::to_engineering_strain<2, double>(moved.strain);
    VoigtStress<2> const unturned = State{}.stress + stiffness() * strain / (1.0 + 200.0 * moved.strain.norm());
    scarp::Tensor<2> const turned = moved.turn * scarp::from_voigt_stress<2, double>(unturned) * moved.turn.transpose();
    trial.stress = scarp::to_voigt_stress<2, double>(turned);
    return {trial.stress, moved.verdict};
  }
  scarp::Response<2> respond(State const& committed, Gradient<2> const& increment, State& trial, int) const {
    return respond(committed, increment, trial);
  }
};

using LazySoftening = scarp::Lazy<Softening>;
static_assert(scarp::PlansWork<LazySoftening>);
static_assert(scarp::PlansWork<scarp::Lazy<scarp::LinearElastic<2>>>);  // that it plans is its own affair

/// Stretch, shear and rotation.
Gradient<2> small_increment() {
  Gradient<2> gradient;
  gradient << 6e-6, 5e-6, 1e-6, -9e-6;
  return gradient;
}

}  // namespace

TEST_CASE("many small increments are answered within the tolerance, with few calls, and the provider loses none") {
  for (double const tolerance : {0.003, 0.03}) {
    LazySoftening const lazy{.provider = {}, .tolerance = tolerance, .largest_strain = 1e-2};
    auto state = lazy.initial_state({});
    Softening::State exact;
    double worst = 0.0;
    int worked = 0;
    constexpr int increments = 400;
    for (int step = 0; step < increments; ++step) {
      auto const plan = lazy.plan(state, small_increment());
      worked += static_cast<long>(plan) > 0 ? 1 : 0;
      auto trial = state;
      auto const answer = lazy.respond(state, small_increment(), trial, plan);
      REQUIRE(answer.verdict.acceptable());
      CHECK(answer.stress == lazy.stress(trial));
      state = trial;
      auto next = exact;
      static_cast<void>(Softening{}.respond(exact, small_increment(), next));
      exact = next;
      worst = std::max(worst, scarp::from_voigt_stress<2, double>(answer.stress - exact.stress).norm() / 1e5);
    }
    MESSAGE("tolerance " << tolerance << ": asked " << state.own.asked << " of " << increments << ", error " << worst);
    CHECK(state.own.asked == worked);
    CHECK(worked < increments / 8);
    // The tolerance is on an estimate from the answer before; beyond its strain curvature is taken as constant here.
    CHECK(worst < 2.0 * tolerance);
    CHECK(worst > 0.0);

    // One more answer makes up for all that was skipped: the provider has then followed one path of the same end.
    auto caught_up = state;
    auto const answer = lazy.respond(state, small_increment(), caught_up, {.asks = true, .own = 20});
    auto next = exact;
    auto const expected = Softening{}.respond(exact, small_increment(), next);
    CHECK(caught_up.skipped.isZero(0.0));
    // Round-off of 400 products, 400 x 1e-16, times stiffness over stress, 400.
    CHECK((answer.stress - expected.stress).norm() < 1e-11 * expected.stress.norm());
  }
}

TEST_CASE("without tolerance every answer has the provider's bits") {
  LazySoftening const lazy{.provider = {}, .tolerance = 0.0};
  auto state = lazy.initial_state({});
  Softening::State own;
  for (int step = 0; step < 20; ++step) {
    auto trial = state;
    auto next = own;
    auto const answer = lazy.respond(state, small_increment(), trial);
    CHECK(answer.stress == Softening{}.respond(own, small_increment(), next).stress);
    CHECK(lazy.tangent(trial) == Softening::stiffness());
    state = trial;
    own = next;
  }
  CHECK(state.own.asked == 20);
}

TEST_CASE("a prediction that runs too far says so, and its refined plan asks the provider") {
  LazySoftening const lazy{.provider = {}, .tolerance = 0.01};
  auto const state = lazy.initial_state({});
  auto const plan = lazy.plan(state, small_increment());
  REQUIRE(static_cast<long>(plan) == 0);
  auto trial = state;
  CHECK(lazy.respond(state, small_increment(), trial, plan).verdict.acceptable());
  CHECK(trial.own.asked == 0);
  CHECK(lazy.tangent(trial) == state.tangent);
  scarp::Verdict const too_far{scarp::Status::not_converged, scarp::Reason::extrapolated};
  CHECK(lazy.respond(state, 100.0 * small_increment(), trial, plan).verdict == too_far);
  auto const refined = lazy.refined(plan);
  CHECK(static_cast<long>(refined) == 20);
  CHECK(static_cast<long>(lazy.refined(refined)) == 40);
  CHECK(lazy.respond(state, 100.0 * small_increment(), trial, refined).verdict.acceptable());
  CHECK(trial.own.asked == 1);
}

TEST_CASE("the learned tangent turns with the material") {
  LazySoftening const lazy{.provider = {}, .tolerance = 0.01};
  auto const state = lazy.initial_state({});
  Gradient<2> quarter_turn;
  quarter_turn << -1.0, -1.0, 1.0, -1.0;
  auto turned = state;
  static_cast<void>(lazy.respond(state, quarter_turn, turned, {.asks = true, .own = 20}));
  // Analytic: axes change places; the sign of shear changes twice. Round-off.
  VoigtTangent<2> const expected = Eigen::Vector3d(20e6, 40e6, 10e6).asDiagonal();
  CHECK((turned.tangent - expected).norm() < 1e-12 * expected.norm());
}

TEST_CASE("bounds that are no bounds are refused") {
  CHECK_REFUSED((LazySoftening{.provider = {}, .tolerance = -1.0}).initial_state({}), "tolerance", "is -1");
  CHECK_REFUSED((LazySoftening{.provider = {}, .largest_strain = 0.0}).initial_state({}), "largest strain", "is 0");
}

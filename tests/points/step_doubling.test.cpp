// SPDX-License-Identifier: BSL-1.0
#include "scarp/points/step_doubling.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "constitutive/nestings.hpp"
#include "constitutive/provider_laws.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "support/approx.hpp"

TEST_CASE("half an increment made twice is the increment") {
  scarp::Gradient<2> gradient;
  gradient << 0.2, 0.15, -0.05, -0.1;
  scarp::Gradient<2> const half = scarp::half_increment<2>(gradient);
  CHECK((half + half + half * half - gradient).norm() < 1e-15);
  CHECK(scarp::half_increment<2>(scarp::Gradient<2>::Zero()).isZero(0.0));
}

TEST_CASE("twice the work is the refined plan, or two halves of a plan that cannot be refined or is none") {
  auto const increment = provider_laws::ordinary_increment<2>(2e-4);
  auto const half = scarp::half_increment<2>(increment);
  auto const check = [&](auto const& provider, auto const& plan, long work, auto const& expected) {
    auto const from = provider.initial_state({});
    auto trial = from;
    auto const answer = scarp::respond_with_double_work(provider, from, increment, plan, trial);
    CHECK(answer.work == work);
    CHECK(answer.response.stress == expected(from));
    CHECK(provider.stress(trial) == answer.response.stress);
  };
  auto const in_halves = [&](auto const& provider, auto const&... plan) {
    return [&](auto const& from) {
      auto middle = from;
      static_cast<void>(provider.respond(from, half, middle, plan...));
      auto end = middle;
      return provider.respond(middle, half, end, plan...).stress;
    };
  };
  nestings::Loosening const provider;
  check(provider, 5, 10, [&](auto const& from) {
    auto end = from;
    return provider.respond(from, increment, end, 10).stress;
  });
  nestings::Loosening const stubborn{.refinement = 1};
  int const plan = 5;
  check(stubborn, plan, 10, in_halves(stubborn, plan));
  auto const elastic = scarp::LinearElastic<2>::from_lame(3e6, 2e6);
  check(elastic, scarp::NoPlan{}, 2, in_halves(elastic));
}

TEST_CASE("stresses differ by the share of the first one, of the least that counts, and infinitely from a failure") {
  scarp::VoigtStress<2> const stress{3.0, 0.0, 0.0};
  scarp::VoigtStress<2> const other{3.0, 0.0, 1.5};  // counts twice: analytic, |difference| = 1.5 sqrt 2
  CHECK(scarp::stress_difference<2>(stress, {other, {}}, 0.0) == samples::Approx(std::sqrt(0.5)).epsilon(1e-14));
  CHECK(scarp::stress_difference<2>(stress, {other, {}}, 6.0) == samples::Approx(std::sqrt(0.125)).epsilon(1e-14));
  CHECK(scarp::stress_difference<2>({0.0, 0.0, 0.0}, {{0.0, 0.0, 0.0}, {}}, 0.0) == 0.0);
  scarp::Verdict const failed{scarp::Status::failed, scarp::Reason::not_finite};
  CHECK(std::isinf(scarp::stress_difference<2>(stress, {stress, failed}, 0.0)));
}

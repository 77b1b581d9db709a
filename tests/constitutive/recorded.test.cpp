// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/recorded.hpp"

#include <doctest/doctest.h>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/material_field.hpp"
#include "scarp/core/random.hpp"

namespace {

using Elastic = scarp::LinearElastic<2>;

/// Elasticity whose answers converge from a plan of 4 on.
struct Planned : Elastic {
  using Plan = int;
  Plan plan(State const&, scarp::Gradient<2> const& increment) const { return increment(0, 0) > 0.0 ? 1 : 2; }
  Plan refined(Plan plan) const { return 2 * plan; }
  using Elastic::respond;
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial,
                             Plan plan) const {
    auto response = Elastic::respond(committed, increment, trial);
    if (plan < 4) response.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
    return response;
  }
};

using Recorded = scarp::Recorded<Planned>;
static_assert(scarp::PlansWork<Recorded> && scarp::ConstitutiveProvider<Recorded>);
static_assert(scarp::ConstitutiveProvider<scarp::Recorded<Elastic>> && !scarp::PlansWork<scarp::Recorded<Elastic>>);

Planned soil() { return {Elastic::from_young_poisson(20e6, 0.3)}; }

scarp::Gradient<2> random_increment(scarp::Random& random) {
  scarp::Gradient<2> increment;
  for (auto& entry : increment.reshaped()) entry = random.uniform(-0.1, 0.1);
  return increment;
}

std::vector<scarp::Site<2>> sites() {
  std::vector<scarp::Site<2>> sites(5);
  for (int k = 0; k < 5; ++k) sites[static_cast<std::size_t>(k)].index = 10 * k;
  return sites;
}

/// Attempts of several evaluations each; every third one is refused. \return the number of those that were accepted
int drive(auto& points, auto const& after_commit) {
  scarp::Random random(4);
  int accepted = 0;
  for (int attempt = 0; attempt < 30; ++attempt) {
    for (int point = 0; point < points.point_count(); ++point) {
      auto const increment = random_increment(random);
      points.plan(point, increment);
      static_cast<void>(points.respond(point, 2.0 * increment));
      while (!points.respond(point, increment).verdict.acceptable()) points.refine_plan(point);
    }
    if (attempt % 3 == 2) continue;
    points.commit();
    ++accepted;
    after_commit();
  }
  return accepted;
}

}  // namespace

TEST_CASE("recorded points answer with the same bits, and only what was committed is in their history") {
  scarp::ProviderField<Planned> plain(soil(), sites());
  std::vector<std::vector<scarp::VoigtStress<2>>> stresses;
  auto const keep = [&] {
    stresses.emplace_back();
    for (int point = 0; point < 5; ++point) stresses.back().push_back(plain.committed_stress(point));
  };
  keep();
  drive(plain, keep);
  scarp::ProviderField<Recorded> recorded({soil(), scarp::PointNumbers{{10, 40}}}, sites());
  int const accepted = drive(recorded, [] {});
  CHECK(accepted == 20);
  for (int point = 0; point < 5; ++point) {
    CHECK(recorded.work(point) == plain.work(point));
    CHECK(recorded.trial(point).own.stress == plain.trial(point).stress);
    CHECK(recorded.committed_tangent(point) == plain.committed_tangent(point));
    auto const rows = recorded.provider().history(recorded.committed(point));
    bool const chosen = point == 1 || point == 4;
    REQUIRE(rows.size() == (chosen ? 21 : 0));  // one for the start
    for (std::size_t k = 0; k < rows.size(); ++k) {
      CHECK(rows[k].stress == stresses[k][static_cast<std::size_t>(point)]);
      CHECK(rows[k].verdict.acceptable());
    }
  }
}

TEST_CASE("points are chosen by any predicate of the site, and without one all are") {
  scarp::Site<2> deep;
  deep.depth = 4.0;
  auto const below = [](scarp::Site<2> const& site) { return site.depth > 3.0; };
  CHECK(Recorded{soil(), below}.initial_state(deep).history.size() == 1);
  CHECK(Recorded{soil(), below}.initial_state({}).history.empty());
  CHECK(Recorded{soil(), {}}.initial_state({}).history.size() == 1);
}

TEST_CASE("gradients of increments that turn and stretch are compounded, and states share their rows") {
  scarp::Recorded<Elastic> const recorded{soil(), {}};
  scarp::Random random(4);
  auto state = recorded.initial_state({});
  scarp::Tensor<2> deformation = scarp::Tensor<2>::Identity();
  for (int step = 0; step < 20; ++step) {
    auto const increment = random_increment(random);
    auto accepted = state;
    auto refused = state;
    static_cast<void>(recorded.respond(state, 2.0 * increment, refused));
    CHECK(recorded.respond(state, increment, accepted).verdict.acceptable());
    CHECK(refused.history.continues(state.history));
    CHECK(accepted.history.continues(state.history));
    CHECK_FALSE(accepted.history.continues(refused.history));
    state = accepted;
    deformation = ((scarp::Tensor<2>::Identity() + increment) * deformation).eval();
  }
  auto const rows = recorded.history(state);
  REQUIRE(rows.size() == 21);
  // Round-off of twenty products.
  CHECK((rows.back().gradient - deformation + scarp::Tensor<2>::Identity()).norm() < 1e-14);
  CHECK(rows.back().stress == state.own.stress);
}

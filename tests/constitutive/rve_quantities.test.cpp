// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/rve_quantities.hpp"

#include <doctest/doctest.h>

#include "constitutive/nestings.hpp"
#include "constitutive/provider_laws.hpp"
#include "scarp/constitutive/linear_elastic.hpp"

TEST_CASE("the balance of a packing is found within every adaptor around every adaptor") {
  auto const increment = provider_laws::ordinary_increment<2>(2e-4);
  nestings::for_each([&](std::string const& name, auto const& provider) {
    CAPTURE(name);
    auto const committed = provider.initial_state({.index = 3});
    auto trial = committed;
    // Refined, a plan asks a provider that would rather predict, and refined once more one within it.
    auto const plan = provider.refined(provider.refined(provider.plan(committed, increment)));
    REQUIRE(provider.respond(committed, increment, trial, plan).verdict.acceptable());
    auto const found = scarp::packing_balance(provider, trial);
    CHECK(found.has_packing);
    CHECK(found.unbalanced_ratio == 1e-3);
    CHECK(found.kinetic_share == 1e-4);
    CHECK(found.inertial_number > 0.0);
  });
}

TEST_CASE("a fluid packing and a point without one have no balance") {
  nestings::Loosening const packing;
  auto state = packing.initial_state({});
  CHECK(scarp::packing_balance(packing, state).has_packing);
  CHECK(packing.respond(packing.initial_state({}), 2e-3 * scarp::Gradient<2>::Identity(), state).verdict.status ==
        scarp::Status::fluid);
  CHECK_FALSE(scarp::packing_balance(packing, state).has_packing);
  auto const elastic = scarp::LinearElastic<2>::from_lame(3e6, 2e6);
  CHECK_FALSE(scarp::packing_balance(elastic, elastic.initial_state({})).has_packing);
}

TEST_CASE("points of varied providers refine their plans by their own provider, also where the common one is none") {
  using Varied = scarp::VariedParameters<scarp::AnyProvider<2>>;
  Varied const varied{{}, [](auto const&, auto const&) { return scarp::AnyProvider<2>(nestings::Loosening{}); }};
  auto const state = varied.initial_state({});
  auto const plan = varied.plan(state, provider_laws::ordinary_increment<2>(2e-4));
  CHECK(static_cast<long>(varied.refined(plan)) == 2 * static_cast<long>(plan));
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/unwrap.hpp"

#include <doctest/doctest.h>

#include "constitutive/nestings.hpp"
#include "constitutive/provider_laws.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/io/state_bits.hpp"
#include "scarp/points/material_points.hpp"

namespace {

using nestings::Loosening;

std::string bits_of(auto const& value) {
  scarp::StateWriter writer;
  writer("value", value);
  return writer.bits();
}

/// visit(provider, state) with the innermost ones, which must be these.
template <class Provider>
void innermost(Provider const& provider, typename Provider::State const& state, auto const& visit) {
  scarp::unwrap(provider, state, [&]<class Inner>(Inner const& inner, typename Inner::State const& own) {
    static_assert(std::same_as<Inner, Loosening>);
    visit(inner, own);
  });
}

/// Sheared, squeezed, then widened until it is fluid, and further.
std::vector<scarp::Gradient<2>> path() {
  auto const identity = scarp::Gradient<2>::Identity();
  return {provider_laws::ordinary_increment<2>(2e-4), -5e-4 * identity, 3e-3 * identity, 1e-3 * identity};
}

}  // namespace

TEST_CASE("the innermost provider and its state are reached within every adaptor around every adaptor") {
  scarp::Site<2> const site{.index = 3};
  nestings::for_each([&](std::string const& name, auto const& provider) {
    CAPTURE(name);
    double factor = 1.0;
    for (auto at = name.find("Varied"); at != name.npos; at = name.find("Varied", at + 1)) factor *= 1.03;
    auto state = provider.initial_state(site);
    Loosening alone;
    Loosening::State expected;
    innermost(provider, state, [&](Loosening const& inner, Loosening::State const& own) {
      CHECK(inner.elasticity.shear_modulus == factor * Loosening{}.elasticity.shear_modulus);
      CHECK(bits_of(own) == bits_of(Loosening{}.initial_state(site)));
      alone = inner;
      expected = own;
    });
    for (auto const& increment : path()) {
      auto const before = state;
      auto const expected_before = expected;
      auto const plan = provider.plan(before, increment);
      static_cast<void>(provider.respond(before, increment, state, plan));
      static_cast<void>(alone.respond(expected_before, increment, expected, alone.plan(expected_before, increment)));
      CHECK(static_cast<long>(provider.refined(plan)) == 2 * alone.plan(expected_before, increment));
      innermost(provider, state,
                [&](Loosening const&, Loosening::State const& own) { CHECK(bits_of(own) == bits_of(expected)); });
    }
    CHECK(expected.verdict.status == scarp::Status::fluid);
  });
}

TEST_CASE("a provider without adaptor is its own innermost one") {
  Loosening const provider;
  auto const state = provider.initial_state({});
  scarp::unwrap(provider, state, [&](Loosening const& inner, Loosening::State const& own) {
    CHECK(&inner == &provider);
    CHECK(&own == &state);
  });
}

TEST_CASE("points tell through every adaptor around every adaptor what the provider itself does") {
  std::vector<scarp::Site<2>> const sites{{.index = 0}, {.index = 3}};
  scarp::SerialExecutor serial;
  nestings::for_each([&](std::string const& name, auto const& provider) {
    CAPTURE(name);
    scarp::MaterialPoints<2> points(provider, sites);
    auto state = provider.initial_state(sites[1]);
    auto path_of_its_own = state;
    std::string followed;
    for (auto const& increment : path()) {
      CAPTURE(increment);
      points.gradient(1) = increment;
      static_cast<void>(points.respond(serial));
      points.commit();
      auto const before = state;
      auto const plan = provider.plan(before, increment);
      static_cast<void>(provider.respond(before, increment, state, plan));
      CHECK(points.pack(1) == bits_of(state));
      CHECK(points.floor_stress(1) == scarp::floor_stress_in<2>(state));
      bool const fluid = points.responses()[1].verdict.status == scarp::Status::fluid;
      CHECK((points.floor_stress(1).norm() > 0.0) == (fluid && name.find("Floor") != name.npos));

      innermost(provider, state, [&](Loosening const& inner, Loosening::State const& own) {
        REQUIRE(!inner.quantities(own).empty());
        CHECK(points.quantities(1) == inner.quantities(own));
        auto const balance = points.packing_balance(1);
        auto const expected = inner.balance(own);
        CHECK(balance.has_packing == !fluid);
        CHECK(balance.has_packing == expected.has_packing);
        CHECK(balance.unbalanced_ratio == expected.unbalanced_ratio);
        CHECK(balance.kinetic_share == expected.kinetic_share);
        CHECK(balance.inertial_number == expected.inertial_number);
      });

      auto trial = before;
      auto const doubled = points.doubled_response(1);
      auto const expected = scarp::respond_with_double_work(provider, before, increment, plan, trial);
      CHECK(doubled.work == 2 * points.work(1));
      CHECK(doubled.work == expected.work);
      CHECK(doubled.response.stress == expected.response.stress);
      CHECK(doubled.response.verdict == expected.response.verdict);
      CHECK(doubled.response.stress != points.committed_stress(1));

      bool const begins = followed.empty();
      auto const answer = points.doubled_path(1, followed);
      if (begins) {
        CHECK(answer.work == 0);
        CHECK(answer.response.stress == points.committed_stress(1));
        path_of_its_own = state;
      } else {
        auto const from = path_of_its_own;
        auto const along = scarp::respond_with_double_work(provider, from, increment, plan, path_of_its_own);
        CHECK(answer.work == along.work);
        CHECK(answer.response.stress == along.response.stress);
      }
      CHECK(followed == bits_of(path_of_its_own));
    }
    CHECK(points.responses()[1].verdict.status == scarp::Status::fluid);
  });
}

TEST_CASE("a fluid packing and a point without one have no balance") {
  Loosening const packing;
  auto state = packing.initial_state({});
  CHECK(packing.balance(state).has_packing);
  CHECK(packing.respond(packing.initial_state({}), 2e-3 * scarp::Gradient<2>::Identity(), state).verdict.status ==
        scarp::Status::fluid);
  CHECK_FALSE(packing.balance(state).has_packing);
  std::vector<scarp::Site<2>> const sites(1);
  scarp::MaterialPoints<2> const elastic(scarp::LinearElastic<2>::from_lame(3e6, 2e6), sites);
  CHECK_FALSE(elastic.packing_balance(0).has_packing);
  CHECK(elastic.quantities(0).empty());
  CHECK(elastic.floor_stress(0).isZero(0.0));
}

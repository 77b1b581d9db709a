// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/any_provider.hpp"

#include <doctest/doctest.h>

#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/material_field.hpp"
#include "scarp/constitutive/packings_by_depth.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using Any = scarp::AnyProvider<2>;
using Elastic = scarp::LinearElastic<2>;
using Rve = scarp::DemRve<samples::Discs, scarp::SamePacking<samples::Discs>>;
using Sand = scarp::StiffnessFloor<Rve>;

Elastic elastic() { return Elastic::from_young_poisson(20e6, 0.3); }

Sand sand() {
  return {.provider = {.law = samples::study_law(), .source = {samples::consolidated<samples::Discs>(80).packing}}};
}

scarp::Gradient<2> shear(double size) {
  scarp::Gradient<2> gradient = scarp::Gradient<2>::Zero();
  gradient(0, 1) = size;
  return gradient;
}

template <class State>
std::string bits(State const& state) {
  scarp::StateWriter writer;
  writer("state", state);
  return writer.bits();
}

/// Elastic, with states that list no members.
struct Unlisted {
  static constexpr int dim = 2;
  struct State {
    Elastic::State own;
  };

  Elastic provider = elastic();

  State initial_state(scarp::Site<2> const& site) const { return {provider.initial_state(site)}; }
  scarp::VoigtStress<2> stress(State const& state) const { return provider.stress(state.own); }
  scarp::VoigtTangent<2> tangent(State const& state) const { return provider.tangent(state.own); }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    return provider.respond(committed.own, increment, trial.own);
  }
};

/// Two load steps of a field of one point, the second one refined.
template <class Provider>
auto walked(Provider const& provider) {
  std::vector<scarp::Site<2>> const sites(1);
  scarp::ProviderField<Provider> field(provider, sites);
  for (int step = 0; step < 2; ++step) {
    field.plan(0, shear(2e-4));
    if (step == 1) field.refine_plan(0);
    static_cast<void>(field.respond(0, shear(1e-4)));
    static_cast<void>(field.respond(0, shear(2e-4)));
    field.commit();
  }
  return field;
}

}  // namespace

TEST_CASE_TEMPLATE("a hidden provider answers as it would in the open", Provider, Elastic, Sand) {
  Provider const open = [] {
    if constexpr (std::is_same_v<Provider, Elastic>) {
      return elastic();
    } else {
      return sand();
    }
  }();
  auto const seen = walked(open);
  auto const hidden = walked(Any(open));
  CHECK(hidden.committed_stress(0) == seen.committed_stress(0));
  CHECK(hidden.committed_tangent(0) == seen.committed_tangent(0));
  CHECK(hidden.work(0) == seen.work(0));
  CHECK(bits(hidden.committed(0)) == bits(seen.committed(0)));
  CHECK(scarp::RveQuantities{}(hidden.provider(), hidden.committed(0)) ==
        scarp::RveQuantities{}(seen.provider(), seen.committed(0)));
  auto const of = [](auto const& field) { return scarp::packing_balance(field.provider(), field.committed(0)); };
  CHECK(of(hidden).has_packing == std::is_same_v<Provider, Sand>);
  CHECK(of(hidden).inertial_number == of(seen).inertial_number);
  auto doubled = [](auto const& field) {
    auto trial = field.replaced(0);
    return scarp::answer_with_double_work(field.provider(), field.replaced(0), shear(2e-4), field.planned(0), trial);
  };
  CHECK(doubled(hidden).work == doubled(seen).work);
  CHECK(doubled(hidden).response.stress == doubled(seen).response.stress);
}

TEST_CASE("states of a hidden provider are values") {
  Any const soil = elastic();
  auto const first = soil.initial_state({});
  auto second = first;
  static_cast<void>(soil.respond(first, shear(1e-3), second));
  auto const third = second;
  static_cast<void>(soil.respond(first, shear(2e-3), second));
  CHECK(first.as<Elastic::State>().stress.norm() == 0.0);
  CHECK(third.as<Elastic::State>().stress(2) < second.as<Elastic::State>().stress(2));
  scarp::AnyState<2> of_another = Any(sand()).initial_state({});
  of_another = third;
  CHECK(soil.stress(of_another) == soil.stress(third));
  scarp::AnyState<2> empty;
  static_cast<void>(soil.respond(third, shear(1e-3), empty));  // a trial state without type takes the committed one's
  CHECK(empty.as<Elastic::State>().stress(2) > third.as<Elastic::State>().stress(2));
  CHECK_THROWS_AS(static_cast<void>(third.as<Sand::State>()), std::bad_cast);
}

TEST_CASE("saved states of a hidden provider are read by its own blank one") {
  Any const soil = sand();
  auto const field = walked(soil);
  auto const saved = bits(field.committed(0));
  auto loaded = soil.blank_state({});
  scarp::StateReader reader(saved);
  reader("state", loaded);
  CHECK(reader.at_end());
  CHECK(bits(loaded) == saved);
  CHECK(soil.stress(loaded) == field.committed_stress(0));
}

TEST_CASE("the floor's stress is found in a hidden state") {
  Sand::State state;
  state.floor_stress << 1.0, 2.0, 3.0;
  scarp::AnyState<2> const hidden(std::make_unique<scarp::detail::HiddenStateOf<2, Sand::State>>(state));
  CHECK(scarp::floor_stress_in<2>(hidden) == state.floor_stress);
  CHECK(scarp::floor_stress_in<2>(Any(elastic()).initial_state({})).norm() == 0.0);
}

TEST_CASE("what a hidden provider cannot do it refuses") {
  CHECK_REFUSED(Any{}.initial_state({}), "AnyProvider", "no provider");
  auto const unlisted = Any(Unlisted{}).initial_state({});
  CHECK_FALSE(unlisted.is_described());
  CHECK_REFUSED(bits(unlisted), "AnyProvider", "members");
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/points/any_provider.hpp"

#include <doctest/doctest.h>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/io/state_bits.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using Any = scarp::AnyProvider<2>;
using Elastic = scarp::LinearElastic<2>;
using Rve = scarp::DemRve<samples::Discs, scarp::SamePacking<samples::Discs>>;
using Sand = scarp::StiffnessFloor<Rve>;

Elastic elastic() { return Elastic::from_young_poisson(20e6, 0.3); }

/// So strict that every answer is refined.
Sand sand() {
  return {.provider = {.law = samples::study_law(),
                       .source = {samples::consolidated<samples::Discs>(80).packing},
                       .unbalanced_tolerance = 1e-9}};
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

std::vector<scarp::Site<2>> const sites(1);

static_assert(scarp::Material<Any> && !scarp::ConstitutiveProvider<Any>);

/// Two load steps of one point, each refined where its answer is not converged.
template <class Material>
scarp::MaterialPoints<2> walked(Material const& material) {
  scarp::MaterialPoints<2> points(material, sites);
  scarp::SerialExecutor serial;
  for (int step = 0; step < 2; ++step) {
    for (double const size : {1e-4, 2e-4}) {
      points.gradient(0) = shear(size);
      static_cast<void>(points.respond(serial, 1));
    }
    points.commit();
  }
  return points;
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
  constexpr bool is_sand = std::is_same_v<Provider, Sand>;
  auto const seen = walked(open);
  auto const hidden = walked(Any(open));
  CHECK(hidden.committed_stress(0) == seen.committed_stress(0));
  CHECK(hidden.committed_tangent(0) == seen.committed_tangent(0));
  CHECK(hidden.initial_tangent(0) == seen.initial_tangent(0));
  CHECK(hidden.work(0) == seen.work(0));
  if constexpr (is_sand) CHECK(hidden.work(0) > open.plan(open.initial_state({}), shear(1e-4)));
  CHECK(hidden.pack(0) == seen.pack(0));
  CHECK(hidden.quantities(0) == seen.quantities(0));
  CHECK(hidden.quantities(0).empty() != is_sand);
  CHECK(hidden.packing_balance(0).has_packing == is_sand);
  CHECK(hidden.packing_balance(0).inertial_number == seen.packing_balance(0).inertial_number);
  CHECK(hidden.picture<scarp::PackingPicture>(0).has_value() == is_sand);
  CHECK(hidden.doubled_response(0).work == seen.doubled_response(0).work);
  CHECK(hidden.doubled_response(0).response.stress == seen.doubled_response(0).response.stress);
}

TEST_CASE("states of a hidden provider are shown as what they are, and as nothing else") {
  scarp::MaterialPoints<2> const points(Any(elastic()), sites);
  CHECK(points.state<Elastic::State>(0).stress.norm() == 0.0);
  CHECK_REFUSED(points.state<Sand::State>(0), "state of point 0", "another type");
}

TEST_CASE("points of one hidden provider are values of their own") {
  Any const soil = elastic();
  scarp::SerialExecutor serial;
  scarp::MaterialPoints<2> first(soil, sites);
  scarp::MaterialPoints<2> second(soil, sites);
  second.gradient(0) = shear(1e-3);
  static_cast<void>(second.respond(serial));
  second.commit();
  CHECK(first.committed_stress(0).norm() == 0.0);
  auto const third = second;
  static_cast<void>(second.respond(serial));
  second.commit();
  CHECK(third.committed_stress(0)(2) > 0.0);
  CHECK(second.committed_stress(0)(2) > third.committed_stress(0)(2));
  first = third;
  CHECK(first.committed_stress(0) == third.committed_stress(0));
}

TEST_CASE("saved states of a hidden provider are read by its own points") {
  Any const soil = sand();
  auto const points = walked(soil);
  auto const saved = points.pack(0);
  scarp::MaterialPoints<2> loaded(soil, sites, {}, [](int) { return false; });
  loaded.unpack(0, saved);
  CHECK(loaded.pack(0) == saved);
  CHECK(loaded.committed_stress(0) == points.committed_stress(0));
  CHECK(loaded.extract(0, saved).pack(0) == saved);
  CHECK_REFUSED(loaded.unpack(0, saved.substr(0, saved.size() / 2)), "save it again");
}

TEST_CASE("the floor's stress is found in a hidden state") {
  scarp::MaterialPoints<2> points(Any(sand()), sites);
  auto state = points.state<Sand::State>(0);
  state.floor_stress << 1.0, 2.0, 3.0;
  points.unpack(0, bits(state));
  CHECK(points.floor_stress(0) == state.floor_stress);
  CHECK(scarp::MaterialPoints<2>(Any(elastic()), sites).floor_stress(0).norm() == 0.0);
}

TEST_CASE("a point that was extracted responds as the one that it was") {
  scarp::SerialExecutor serial;
  scarp::MaterialPoints<2> points(Any(elastic()), sites);
  auto one = points.extract(0, points.pack(0));
  for (auto* of : {&points, &one}) {
    of->gradient(0) = shear(1e-4);
    CHECK(of->respond(serial).verdict == scarp::Verdict{});
    of->commit();
  }
  CHECK(one.committed_stress(0).norm() > 0.0);
  CHECK(one.committed_stress(0) == points.committed_stress(0));
}

TEST_CASE("materials of points are numbers of the materials given, one for each") {
  std::vector<Any> const two{Any(elastic()), Any(sand())};
  auto const points = [&](std::vector<int> const& material_of) {
    return scarp::MaterialPoints<2>(two, material_of, sites, {}, [](int) { return true; });
  };
  std::vector<int> numbers(sites.size(), 1);
  CHECK(points(numbers).size() == static_cast<int>(sites.size()));
  numbers.back() = 2;
  CHECK_REFUSED(points(numbers), "the material 2", "there are 2");
  numbers.back() = -1;
  CHECK_REFUSED(points(numbers), "the material -1");
  numbers.pop_back();
  CHECK_REFUSED(points(numbers), "numbers of materials", "give one to each");
}

TEST_CASE("what a hidden provider cannot do it refuses") {
  CHECK_REFUSED((scarp::MaterialPoints<2>(Any{}, sites)), "AnyProvider", "no provider");
  scarp::MaterialPoints<2> unlisted(Any(Unlisted{}), sites);
  CHECK_REFUSED(unlisted.pack(0), "states of a provider", "members");
  CHECK_REFUSED(unlisted.unpack(0, ""), "states of a provider", "members");
  CHECK_REFUSED(bits(unlisted), "states of a provider", "members");
  std::string followed;
  CHECK(unlisted.doubled_path(0, followed).work == 0);
  CHECK(followed.empty());
}

// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/varied_parameters.hpp"

#include <doctest/doctest.h>

#include "constitutive/nestings.hpp"
#include "constitutive/provider_laws.hpp"
#include "scarp/constitutive/correlated_field.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/points/material_points.hpp"
#include "support/approx.hpp"

namespace {

using Elastic = scarp::LinearElastic<2>;
using Varied = scarp::VariedParameters<Elastic>;

static_assert(scarp::ConstitutiveProvider<Varied> && !scarp::HasPlan<Varied>);

Varied random_soil() {
  scarp::CorrelatedField<2> const field({.lengths = {20.0, 2.0}, .seed = 7});
  scarp::Lognormal const young{.mean = 20e6, .variation = 0.4};
  return {{}, [=](Elastic const&, scarp::Site<2> const& site) {
            return Elastic::from_young_poisson(young.of(field(site.position)), 0.3);
          }};
}

scarp::Site<2> place(int index, double x, double y) {
  return {.index = index, .region = 0, .position = {x, y}, .depth = 0.0};
}

}  // namespace

TEST_CASE("every point answers with the parameters of its own place") {
  std::vector<scarp::Site<2>> sites;
  for (int k = 0; k < 50; ++k) sites.push_back(place(k, 3.0 * k, 0.1 * k));
  auto const soil = random_soil();
  scarp::MaterialPoints<2> points(soil, sites);
  scarp::Gradient<2> stretch = scarp::Gradient<2>::Zero();
  stretch(1, 1) = -1e-4;
  for (int k = 0; k < points.size(); ++k) points.gradient(k) = stretch;
  scarp::SerialExecutor serial;
  static_cast<void>(points.respond(serial));
  double softest = 1e300;
  double stiffest = 0.0;
  for (int k = 0; k < points.size(); ++k) {
    auto const own = soil.vary({}, sites[static_cast<std::size_t>(k)]);
    auto alone = own.initial_state({});
    CHECK(points.stress(k) == own.respond(alone, stretch, alone).stress);
    CHECK(points.committed_tangent(k) == own.tangent(alone));
    softest = std::min(softest, own.elasticity.shear_modulus);
    stiffest = std::max(stiffest, own.elasticity.shear_modulus);
  }
  CHECK(stiffest > 1.5 * softest);
}

TEST_CASE("the parameters of a place depend on neither its number nor what was asked before") {
  auto const soil = random_soil();
  auto const first = soil.initial_state(place(0, 5.0, 6.0));
  static_cast<void>(soil.initial_state(place(1, 70.0, 2.0)));
  auto const again = random_soil().initial_state(place(9, 5.0, 6.0));
  CHECK(soil.tangent(first) == soil.tangent(again));
}

TEST_CASE("copies of a state share its provider") {
  auto const soil = random_soil();
  auto const state = soil.initial_state(place(0, 5.0, 6.0));
  auto trial = soil.initial_state(place(1, 70.0, 2.0));
  static_cast<void>(soil.respond(state, scarp::Gradient<2>::Zero(), trial));
  CHECK(trial.provider == state.provider);
}

TEST_CASE("points of varied providers refine their plans by their own provider") {
  using nestings::Loosening;
  scarp::VariedParameters<Loosening> const varied{{.refinement = 2},
                                                  [](auto const&, auto const&) { return Loosening{.refinement = 3}; }};
  auto const plan = varied.plan(varied.initial_state({}), provider_laws::ordinary_increment<2>(2e-4));
  CHECK(static_cast<long>(varied.refined(plan)) == 3 * static_cast<long>(plan));
}

TEST_CASE("a state that goes to another point is that of a material with the parameters there") {
  scarp::SerialExecutor serial;
  Varied const soil{{}, [](Elastic const&, scarp::Site<2> const& site) {
                      return Elastic::from_young_poisson(site.index == 0 ? 1e6 : 5e6, 0.3);
                    }};
  std::vector<scarp::Site<2>> const sites{{.index = 0}, {.index = 1}};
  scarp::MaterialPoints<2> copied(soil, sites), unpacked(soil, sites);
  copied.copy(1, copied, 0);
  unpacked.unpack(1, unpacked.pack(0));
  for (auto* const points : {&copied, &unpacked}) {
    for (int k = 0; k < 2; ++k) points->gradient(k)(0, 0) = 1e-3;
    REQUIRE(points->respond(serial).verdict.acceptable());
  }
  CHECK(copied.stress(1) == unpacked.stress(1));
  CHECK(copied.stress(1)(0) == samples::Approx(5.0 * copied.stress(0)(0)));
}

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <utility>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/constitutive/unwrap.hpp"
#include "scarp/constitutive/varied_parameters.hpp"

/// Every adaptor around every adaptor, for the laws of what is saved.
namespace nestings {

/// Elasticity that stiffens along its path, counts as fluid where it is wider than at the start, plans work and is
/// balanced as packings are.
struct Loosening {
  static constexpr int dim = 2;
  using Plan = int;
  struct State {
    scarp::Tensor<2> strain = scarp::Tensor<2>::Zero();
    double path = 0.0;
    double unbalanced_ratio = 0.0;
    double kinetic_share = 0.0;
    double inertial_number = 0.0;
    scarp::Verdict verdict{};

    SCARP_MEMBERS(strain, path, unbalanced_ratio, kinetic_share, inertial_number, verdict)
  };

  scarp::IsotropicElasticity elasticity{6e6, 4e6};
  int refinement = 2;  ///< of a plan, as a factor

  State initial_state(scarp::Site<2> const&) const { return {.strain = -1e-3 * scarp::Tensor<2>::Identity()}; }
  scarp::VoigtTangent<2> tangent(State const& state) const { return (1.0 + state.path) * elasticity.stiffness<2>(); }
  scarp::VoigtStress<2> stress(State const& state) const {
    return tangent(state) * scarp::to_engineering_strain<2, double>(state.strain);
  }
  Plan plan(State const& committed, scarp::Gradient<2> const& increment) const {
    return 3 + static_cast<int>(1e4 * (increment.norm() + committed.path));
  }
  Plan refined(Plan plan) const { return refinement * plan; }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    return respond(committed, increment, trial, plan(committed, increment));
  }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial,
                             Plan plan) const {
    trial.strain = committed.strain + (increment + increment.transpose()) / 2.0;
    trial.path = committed.path + increment.norm() * (1.0 + 1.0 / plan);
    bool const wider = trial.strain.trace() > 0.0;
    trial.unbalanced_ratio = 1e-3;
    trial.kinetic_share = 1e-4;
    trial.inertial_number = increment.norm() / plan;
    trial.verdict = wider ? scarp::Verdict{scarp::Status::fluid, scarp::Reason::no_contacts} : scarp::Verdict{};
    return {stress(trial), trial.verdict};
  }
  scarp::Quantities quantities(State const& state) const {
    return {{"path", state.path}, {"shear_modulus", elasticity.shear_modulus}};
  }
  scarp::PackingBalance balance(State const& state) const {
    if (state.verdict.status == scarp::Status::fluid) return {};
    return {true, state.unbalanced_ratio, state.kinetic_share, state.inertial_number};
  }
};

static_assert(scarp::HasPlan<Loosening>);

/// Makes a provider another one for each site, whatever is around it.
template <class Provider>
void stiffen(Provider& provider, double by) {
  if constexpr (requires { provider.elasticity; }) {
    provider.elasticity.lame_lambda *= by;
    provider.elasticity.shear_modulus *= by;
  } else if constexpr (requires { provider.law.normal_stiffness; }) {
    provider.law.normal_stiffness *= by;
  } else if constexpr (requires { provider.provider; }) {
    stiffen(provider.provider, by);
  } else if constexpr (requires { provider.common; }) {
    stiffen(provider.common, by);
  }
}

struct Floored {
  static constexpr char const* name = "StiffnessFloor";
  template <class Provider>
  static auto around(Provider provider) {
    return scarp::StiffnessFloor<Provider>{std::move(provider), 1e-2};
  }
};
struct Varied {
  static constexpr char const* name = "VariedParameters";
  template <class Provider>
  static auto around(Provider provider) {
    return scarp::VariedParameters<Provider>{std::move(provider),
                                             [](Provider const& common, scarp::Site<2> const& site) {
                                               Provider own = common;
                                               stiffen(own, 1.0 + 0.01 * (site.index % 5));
                                               return own;
                                             }};
  }
};

/// visit(adaptor) for each.
template <class Visit>
void for_each_adaptor(Visit const& visit) {
  visit(Floored{}), visit(Varied{});
}

/// visit(name, provider) for each adaptor around each, another one of its own kind too.
template <class Visit>
void for_each(Visit const& visit) {
  for_each_adaptor([&](auto outer) {
    for_each_adaptor([&](auto inner) {
      visit(std::string(outer.name) + " around " + inner.name, outer.around(inner.around(Loosening{})));
    });
  });
}

}  // namespace nestings

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <memory>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"

namespace scarp {

/// A provider of its own for every point, made from a common one and the point's site, as from a random field:
/// \code
/// CorrelatedField<2> const field({.lengths = {20.0, 2.0}, .seed = 7});
/// Lognormal const young{.mean = 20e6, .variation = 0.4};
/// VariedParameters<LinearElastic<2>> soil{{}, [=](LinearElastic<2> const&, Site<2> const& site) {
///   return LinearElastic<2>::from_young_poisson(young.of(field(site.position)), 0.3);
/// }};
/// \endcode
/// States share their point's provider; a copy of a state does not copy it.
template <CheckedProvider Provider>
struct VariedParameters {
  static constexpr int dim = Provider::dim;
  static constexpr bool exact_tangent = has_exact_tangent<Provider>();  ///< as the provider inside

  /// Made by the point's own provider, which also refines it.
  struct Plan {
    std::shared_ptr<Provider const> provider;  ///< null before the first plan
    PlanOf<Provider> own{};                    ///< of that provider

    /// Number of inner steps that are planned.
    explicit operator long() const requires HasPlan<Provider> { return static_cast<long>(own); }
  };

  /// Provider of a point and its state.
  struct State {
    std::shared_ptr<Provider const> provider;  ///< of the point, shared by all its states
    typename Provider::State own;              ///< of that provider

    /// Without the provider: that one follows from the site.
    template <class Self, class Visit>
    static void members(Self& self, Visit&& visit) requires Described<typename Provider::State> {
      SCARP_ALL_MEMBERS(provider, own);
      visit("own", self.own);
    }
  };

  Provider common{};  ///< passed to `vary`, and in no other use
  /// The provider of a point, from `common` and the point's site.
  std::function<Provider(Provider const&, Site<dim> const&)> vary{};

  /// \throws InputError without a function that varies
  void validate() const {
    if (!vary) reject("points have no parameters of their own (no function varies the common ones): give `vary`");
  }

  /// Makes the point's own provider and its initial state.
  /// \throws InputError as validate() does, and whatever the function that varies throws
  State initial_state(Site<dim> const& site) const {
    auto own = provider_at(site);
    auto state = own->initial_state(site);
    return {std::move(own), std::move(state)};
  }

  State empty_state(Site<dim> const& site) const {
    auto own = provider_at(site);
    auto state = scarp::empty_state(*own, site);
    return {std::move(own), std::move(state)};
  }

  VoigtStress<dim> stress(State const& state) const { return state.provider->stress(state.own); }
  VoigtTangent<dim> tangent(State const& state) const { return state.provider->tangent(state.own); }

  Plan plan(State const& committed, Gradient<dim> const& increment) const requires HasPlan<Provider> {
    return {committed.provider, committed.provider->plan(committed.own, increment)};
  }

  Plan refined(Plan const& plan) const requires HasPlan<Provider> {
    return plan.provider ? Plan{plan.provider, plan.provider->refined(plan.own)} : plan;
  }

  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial) const {
    trial.provider = committed.provider;
    return committed.provider->respond(committed.own, increment, trial.own);
  }
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial,
                        Plan const& plan) const requires HasPlan<Provider> {
    trial.provider = committed.provider;
    return committed.provider->respond(committed.own, increment, trial.own, plan.own);
  }

 private:
  std::shared_ptr<Provider const> provider_at(Site<dim> const& site) const {
    validate();
    return std::make_shared<Provider const>(vary(common, site));
  }
};

}  // namespace scarp

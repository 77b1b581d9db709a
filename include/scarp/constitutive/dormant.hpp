// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>

#include "scarp/constitutive/blank_state.hpp"
#include "scarp/constitutive/checked_provider.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"

namespace scarp {

/// Any provider whose points wait, as the lifts of an embankment do until they are placed. A waiting point carries no
/// stress; a small stiffness that answers nothing lets its nodes follow the ground below. Once woken it starts in the
/// configuration of that moment from the provider's own initial state, whatever it was strained before:
/// \code
/// run.settle(...);
/// activate(problem, [](Site<2> const& site) { return site.region == 1; });
/// run.run(...);
/// \endcode
template <CheckedProvider Provider>
struct Dormant {
  static constexpr int dim = Provider::dim;
  using Plan = PlanOf<Provider>;

  struct State {
    Site<dim> site;
    bool awake = false;
    typename Provider::State own;

    SCARP_MEMBERS_EXCEPT((site), awake, own)
  };

  Provider provider{};
  double share = 1e-4;  ///< of the initial stiffness, in the tangent of a waiting point

  /// \throws InputError for a share that is not finite and positive
  State initial_state(Site<dim> const& site) const {
    require_positive("share of a dormant point's stiffness", share);
    return {site, false, provider.initial_state(site)};
  }

  State blank_state(Site<dim> const& site) const { return {site, false, scarp::blank_state(provider, site)}; }

  VoigtStress<dim> stress(State const& state) const {
    return state.awake ? provider.stress(state.own) : VoigtStress<dim>(VoigtStress<dim>::Zero());
  }

  VoigtTangent<dim> tangent(State const& state) const {
    return (state.awake ? 1.0 : share) * provider.tangent(state.own);
  }

  /// Nothing is to be done for a point that waits.
  Plan plan(State const& committed, Gradient<dim> const& increment) const requires PlansWork<Provider> {
    return committed.awake ? provider.plan(committed.own, increment) : Plan{};
  }
  Plan refined(Plan const& plan) const requires PlansWork<Provider> { return provider.refined(plan); }

  /// A waiting point fails with `not_finite` on NaN or infinity, else its answer is zero.
  /// \param plan the provider's, or none
  template <class... PlanType>
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial,
                        PlanType const&... plan) const {
    trial.site = committed.site;
    trial.awake = committed.awake;
    if (committed.awake) return provider.respond(committed.own, increment, trial.own, plan...);
    trial.own = committed.own;
    Verdict const verdict = increment.allFinite() ? Verdict{} : Verdict{Status::failed, Reason::not_finite};
    return {VoigtStress<dim>::Zero(), verdict};
  }
};

/// Wakes the waiting points that are chosen. Between runs only: a solver's session remembers tangents.
/// materials: what has for_each_committed(visit(state)); other providers' states are passed over
/// chosen(site): whether a point is to wake, told where it was when its state was made
/// \return how many have woken, of the points of this process
template <class Materials, class Chosen>
int activate(Materials& materials, Chosen const& chosen) {
  int woken = 0;
  materials.for_each_committed([&](auto& state) {
    if constexpr (requires { state.awake; }) {
      if (state.awake || !chosen(state.site)) return;
      state.awake = true;
      ++woken;
    }
  });
  return woken;
}

}  // namespace scarp

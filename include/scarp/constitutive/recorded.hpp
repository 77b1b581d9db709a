// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "scarp/constitutive/blank_state.hpp"
#include "scarp/constitutive/checked_provider.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/shared_history.hpp"

namespace scarp {

/// Chooses points by their numbers in the mesh.
struct PointNumbers {
  std::vector<int> numbers;

  template <int Dim>
  bool operator()(Site<Dim> const& site) const {
    return std::find(numbers.begin(), numbers.end(), site.index) != numbers.end();
  }
};

/// What a point has come to at the end of an increment.
template <int Dim>
struct HistoryRow {
  VoigtStress<Dim> stress = VoigtStress<Dim>::Zero();  ///< Cauchy [Pa], tension positive
  Gradient<Dim> gradient = Gradient<Dim>::Zero();  ///< since the start, of all increments: (I + G_n) ... (I + G_1) - I
  Verdict verdict;

  SCARP_MEMBERS(stress, gradient, verdict)
};

/// Any provider with the history of chosen points: one row for the start and one for every committed increment. Rows belong to
/// the states, so that those of refused steps vanish with them, and states share the memory of what they have in common.
template <CheckedProvider Provider>
struct Recorded {
  static constexpr int dim = Provider::dim;
  using Plan = PlanOf<Provider>;

  struct State {
    typename Provider::State own;
    SharedHistory<HistoryRow<dim>> history;  ///< empty for a point that was not chosen

    SCARP_MEMBERS(own, history)
  };

  Provider provider{};
  std::function<bool(Site<dim> const&)> chosen{};  ///< empty: every point

  State initial_state(Site<dim> const& site) const {
    State state{provider.initial_state(site), {}};
    if (!chosen || chosen(site)) state.history.push_back({provider.stress(state.own), Gradient<dim>::Zero(), {}});
    return state;
  }

  State blank_state(Site<dim> const& site) const { return {scarp::blank_state(provider, site), {}}; }

  VoigtStress<dim> stress(State const& state) const { return provider.stress(state.own); }
  VoigtTangent<dim> tangent(State const& state) const { return provider.tangent(state.own); }

  /// The rows so far; none for a point that was not chosen.
  std::vector<HistoryRow<dim>> history(State const& state) const { return state.history.rows(); }

  Plan plan(State const& committed, Gradient<dim> const& increment) const requires PlansWork<Provider> {
    return provider.plan(committed.own, increment);
  }
  Plan refined(Plan const& plan) const requires PlansWork<Provider> { return provider.refined(plan); }

  /// \param plan the provider's, or none
  template <class... PlanType>
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial,
                        PlanType const&... plan) const {
    auto const response = provider.respond(committed.own, increment, trial.own, plan...);
    trial.history = committed.history;
    if (!committed.history.empty()) {
      Gradient<dim> const before = committed.history.back().gradient;
      trial.history.push_back({response.stress, before + increment + increment * before, response.verdict});
    }
    return response;
  }
};

template <class Provider>
Recorded(Provider, std::function<bool(Site<Provider::dim> const&)>) -> Recorded<Provider>;

}  // namespace scarp

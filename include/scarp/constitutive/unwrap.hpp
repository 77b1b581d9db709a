// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"

namespace scarp {

/// Calls visit(provider, state) for the provider inside all adaptors, whose state contains no other provider's. An
/// adaptor's state has a member `own`, and `provider` where every point has another one; else the adaptor itself has
/// that member.
template <class Provider, class State, class Visit>
decltype(auto) unwrap(Provider const& provider, State& state, Visit&& visit) {
  if constexpr (requires {
                  *state.provider;
                  state.own;
                }) {
    return unwrap(*state.provider, state.own, std::forward<Visit>(visit));
  } else if constexpr (requires {
                         state.own;
                         provider.provider;
                       }) {
    return unwrap(provider.provider, state.own, std::forward<Visit>(visit));
  } else {
    return std::forward<Visit>(visit)(provider, state);
  }
}

/// Gives a state what belongs to its point and not to its history, from another state of that point: a provider of the
/// point's own, and a member `place`.
template <class State>
void keep_place(State& state, State const& of_point) {
  if constexpr (requires { *state.provider; }) state.provider = of_point.provider;
  if constexpr (requires { state.place; }) state.place = of_point.place;
  if constexpr (requires { state.own; }) keep_place(state.own, of_point.own);
}

/// Named numbers of a material point, which a provider returns by `Quantities quantities(State const&) const`.
using Quantities = std::vector<std::pair<std::string_view, double>>;

/// How well the packing of a point is balanced, and how fast its last response strained it: a provider returns it by
/// `PackingBalance balance(State const&) const`.
struct PackingBalance {
  bool has_packing = false;       ///< false: the other members mean nothing
  double unbalanced_ratio = 0.0;  ///< mean net force of a grain over mean contact force
  double kinetic_share = 0.0;     ///< of moving grains in the packing's pressure
  double inertial_number = 0.0;   ///< of the last response
};

/// Stress [Pa] of a stiffness floor in a state, or in the state within it; zero without a floor.
template <int Dim, class State>
VoigtStress<Dim> floor_stress_in(State const& state) {
  if constexpr (requires { state.floor_stress; }) {
    return state.floor_stress;
  } else if constexpr (requires { state.own; }) {
    return floor_stress_in<Dim>(state.own);
  } else {
    return VoigtStress<Dim>::Zero();
  }
}

}  // namespace scarp

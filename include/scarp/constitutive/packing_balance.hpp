// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/constitutive_provider.hpp"

namespace scarp {

/// How well the packing of a point is balanced, and how fast it was strained.
struct PackingBalance {
  bool has_packing = false;
  double unbalanced_ratio = 0.0;
  double kinetic_share = 0.0;
  double inertial_number = 0.0;
};

/// Of the packing below adaptors that share its plan, after an answer; packings at less than the provider's loose pressure
/// count by their share of it. Without a packing, and of one that is fluid, nothing.
/// before, after: states that the answer began and ended with
template <class Provider, class State, class Plan>
PackingBalance packing_balance(Provider const& provider, State const& before, State const& after,
                               Gradient<Provider::dim> const& increment, Plan const& plan) {
  if constexpr (requires { provider.packing_balance(before, after, increment, plan); }) {
    return provider.packing_balance(before, after, increment, plan);
  } else if constexpr (requires { provider.inertial_number_of(before, increment, plan); }) {
    if (after.verdict.status == Status::fluid) return {};
    double const weight = provider.weight_of(after);
    return {.has_packing = true,
            .unbalanced_ratio = weight * after.unbalanced_ratio,
            .kinetic_share = weight * after.kinetic_share,
            .inertial_number = provider.inertial_number_of(before, increment, plan)};
  } else if constexpr (requires { provider.provider, before.own; }) {
    return packing_balance(provider.provider, before.own, after.own, increment, plan);
  } else {
    return {};
  }
}

}  // namespace scarp

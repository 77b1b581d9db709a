// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <utility>

namespace scarp {

/// Calls visit(provider, state) for what adaptors are around: the provider that keeps no state of another one in its own.
template <class Provider, class State, class Visit>
decltype(auto) visit_innermost(Provider const& provider, State const& state, Visit&& visit) {
  if constexpr (requires {
                  *state.provider;
                  state.own;
                }) {
    return visit_innermost(*state.provider, state.own, std::forward<Visit>(visit));
  } else if constexpr (requires { state.own; }) {
    return visit_innermost(provider.provider, state.own, std::forward<Visit>(visit));
  } else {
    return std::forward<Visit>(visit)(provider, state);
  }
}

}  // namespace scarp

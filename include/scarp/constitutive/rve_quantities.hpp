// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/dem/packing_picture.hpp"
#include "scarp/homogenise/fabric.hpp"

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

/// Named numbers of a material point.
using Quantities = std::vector<std::pair<std::string_view, double>>;

/// What an observer may ask of points that have nothing but stress.
struct NoQuantities {
  template <class Provider>
  Quantities operator()(Provider const&, typename Provider::State const&) const {
    return {};
  }
};

/// Void ratio, in the plane fabrics, coordination and balance of points that carry a packing, also within adaptors; nothing of others.
struct RveQuantities {
  template <class Provider>
  Quantities operator()(Provider const& provider, typename Provider::State const& state) const {
    return visit_innermost(provider, state, [](auto const& inner, auto const& own) { return of(inner, own); });
  }

 private:
  template <class Provider>
  static Quantities of(Provider const& provider, typename Provider::State const& state) {
    if constexpr (requires { provider.quantities(state); }) {
      return provider.quantities(state);
    } else if constexpr (requires { state.packing.void_ratio(); }) {
      Quantities quantities{{"void_ratio", state.packing.void_ratio()}};
      if constexpr (Provider::dim == 2)
        quantities.emplace_back("contact_fabric", fabric_anisotropy(contact_fabric(state.packing, provider.law)));
      quantities.emplace_back("coordination", coordination(state.packing, provider.law).all);
      quantities.emplace_back("unbalanced_ratio", state.unbalanced_ratio);
      if constexpr (requires { particle_fabric(state.packing); }) {
        quantities.emplace_back("particle_fabric", fabric_anisotropy(particle_fabric(state.packing)));
      }
      return quantities;
    } else {
      return {};
    }
  }
};

/// The packing that a point carries, also within adaptors and an `AnyProvider`, as a drawing needs it; nothing of points
/// without one and of packings that have no picture.
template <class Provider>
std::optional<PackingPicture> packing_in(Provider const& provider, typename Provider::State const& state) {
  return visit_innermost(provider, state, [](auto const& inner, auto const& own) -> std::optional<PackingPicture> {
    if constexpr (requires { inner.packing_in(own); }) {
      return inner.packing_in(own);
    } else if constexpr (requires { packing_picture(own.packing, inner.law); }) {
      if (own.packing.population) return packing_picture(own.packing, inner.law);
    }
    return std::nullopt;
  });
}

/// How well the packing of a point is balanced, and how fast its last answer strained it.
struct PackingBalance {
  bool has_packing = false;
  double unbalanced_ratio = 0.0;
  double kinetic_share = 0.0;
  double inertial_number = 0.0;
};

/// Of the packing of a point, also within adaptors; packings at less than the provider's loose pressure count by their share of
/// it. Without a packing, and of one that is fluid, nothing.
template <class Provider>
PackingBalance packing_balance(Provider const& provider, typename Provider::State const& state) {
  return visit_innermost(provider, state, [](auto const& inner, auto const& own) -> PackingBalance {
    if constexpr (requires { inner.packing_balance(own); }) {
      return inner.packing_balance(own);
    } else if constexpr (requires { inner.weight_of(own), own.inertial_number; }) {
      if (own.verdict.status == Status::fluid) return {};
      double const weight = inner.weight_of(own);
      return {.has_packing = true,
              .unbalanced_ratio = weight * own.unbalanced_ratio,
              .kinetic_share = weight * own.kinetic_share,
              .inertial_number = own.inertial_number};
    }
    return {};
  });
}

}  // namespace scarp

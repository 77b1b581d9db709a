// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/constitutive/innermost.hpp"
#include "scarp/homogenise/coordination.hpp"
#include "scarp/homogenise/fabric.hpp"

namespace scarp {

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

}  // namespace scarp

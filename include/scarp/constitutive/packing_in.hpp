// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>

#include "scarp/constitutive/innermost.hpp"
#include "scarp/dem/packing_picture.hpp"

namespace scarp {

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

}  // namespace scarp

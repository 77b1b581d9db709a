// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <numbers>

#include "scarp/core/precompiled.hpp"
#include "scarp/shape/round_grain.hpp"

namespace scarp {

/// Spherical grain in space; size is (radius).
struct Sphere : RoundGrain<3> {
  /// Volume [m3].
  static double content(Size<double> const& size) { return 4.0 / 3.0 * std::numbers::pi * size[0] * size[0] * size[0]; }
  /// About any axis through the centre.
  static double gyration_squared(Size<double> const& size) { return 0.4 * size[0] * size[0]; }
};

static_assert(ParticleShape<Sphere>);

/// Spheres are among the shapes of `scarp::precompiled`.
template <>
inline constexpr bool is_precompiled<Sphere> = detail::has_library;

}  // namespace scarp

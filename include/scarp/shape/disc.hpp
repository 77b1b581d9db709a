// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <numbers>

#include "scarp/core/precompiled.hpp"
#include "scarp/shape/round_grain.hpp"

namespace scarp {

/// Circular grain in the plane; size is (radius).
struct Disc : RoundGrain<2> {
  static double content(Size<double> const& size) { return std::numbers::pi * size[0] * size[0]; }  ///< Area [m2].
  /// Polar second moment about the centre over the area, \f$ r^2/2 \f$ [m2].
  static double gyration_squared(Size<double> const& size) { return size[0] * size[0] / 2.0; }
};

static_assert(ParticleShape<Disc>);

/// Discs are among the shapes of `scarp::precompiled`.
template <>
inline constexpr bool is_precompiled<Disc> = detail::has_library;

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

#include "scarp/core/constant.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/dem/damping.hpp"

namespace scarp {

/// Cundall's local damping: the net force loses the share `factor` where it does work and gains it where it resists. Grains
/// that touch nothing feel no force and would fly on for ever, so all fluctuation velocities also lose the small share
/// `drag` in every step.
struct LocalDamping {
  double factor = 0.2;
  double drag = 1e-3;

  /// Velocity after a step with a net force, or spin after one with a net torque; mobility = time step / inertia.
  template <class T>
  T next_velocity(T const& velocity, T const& force, T const& mobility) const {
    using std::abs;
    using std::copysign;
    T const damped = force - constant<T>(factor) * copysign(abs(force), velocity);
    return constant<T>(1.0 - drag) * velocity + damped * mobility;
  }
};

static_assert(DampsMotion<LocalDamping>);

template <>
inline constexpr bool is_precompiled<LocalDamping> = detail::has_library;

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <numbers>

namespace retaining_wall {

/// Active: away from the ground; passive: into it.
enum class Movement { active, passive };

inline char const* name(Movement movement) { return movement == Movement::active ? "active" : "passive"; }
inline double sign_of(Movement movement) { return movement == Movement::active ? -1.0 : 1.0; }

/// Horizontal over vertical stress of cohesionless ground that yields behind a smooth wall (Rankine 1857),
/// \f$ K = \tan^2(45° \mp \varphi/2) \f$; friction [rad]
inline double rankine(Movement movement, double friction) {
  double const root = std::tan(std::numbers::pi / 4.0 + sign_of(movement) * friction / 2.0);
  return root * root;
}

/// Angle of friction [rad] that such a ratio of stresses mobilises.
inline double mobilised(double ratio) { return std::asin(std::abs(ratio - 1.0) / (ratio + 1.0)); }

inline double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

}  // namespace retaining_wall

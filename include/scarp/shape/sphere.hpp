// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <numbers>

#include "scarp/shape/round_touch.hpp"

namespace scarp {

/// Spherical grain in space; size is (radius).
struct Sphere {
  static constexpr int dim = 3;
  static constexpr int size_count = 1;
  static constexpr int orientation_count = 0;
  static constexpr int pose_count = 1;
  static constexpr bool remembers_normal = false;

  template <class T>
  using Size = std::array<T, 1>;

  static double content(Size<double> const& size) { return 4.0 / 3.0 * std::numbers::pi * size[0] * size[0] * size[0]; }
  /// About any axis through the centre.
  static double gyration_squared(Size<double> const& size) { return 0.4 * size[0] * size[0]; }
  static double bounding_radius(Size<double> const& size) { return size[0]; }
  static double eccentricity(Size<double> const&) { return 0.0; }
  static double least_curvature_radius(Size<double> const& size) { return size[0]; }

  template <class T>
  static std::array<T, 1> pose(Size<T> const& size, std::array<T, 0> const&) {
    return size;
  }

  template <class T>
  static T contact_radius(std::array<T, 1> const& pose) {
    return pose[0];
  }

  template <class T>
  static Touch<3, T> touch(std::array<T, 1> const& first, std::array<T, 1> const& second, Point<3, T> const& branch,
                           Point<3, T> const&) {
    return round_touch<3, T>(first[0], second[0], branch);
  }
};

static_assert(ParticleShape<Sphere>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <numbers>

#include "scarp/shape/round_touch.hpp"

namespace scarp {

/// Circular grain in the plane; size is (radius).
struct Disc {
  static constexpr int dim = 2;
  static constexpr int size_count = 1;
  static constexpr int orientation_count = 0;
  static constexpr int pose_count = 1;
  static constexpr bool remembers_normal = false;

  template <class T>
  using Size = std::array<T, 1>;

  static double content(Size<double> const& size) { return std::numbers::pi * size[0] * size[0]; }
  static double gyration_squared(Size<double> const& size) { return size[0] * size[0] / 2.0; }
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
  static Touch<2, T> touch(std::array<T, 1> const& first, std::array<T, 1> const& second, Point<2, T> const& branch,
                           Point<2, T> const&) {
    return round_touch<2, T>(first[0], second[0], branch);
  }
};

static_assert(ParticleShape<Disc>);

}  // namespace scarp

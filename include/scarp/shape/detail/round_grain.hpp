// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/shape/round_touch.hpp"

namespace scarp {

/// What discs and spheres have in common: a size that is their radius, and no orientation.
template <int Dim>
struct RoundGrain {
  static constexpr int dim = Dim;
  static constexpr int size_count = 1;
  static constexpr int orientation_count = 0;
  static constexpr int pose_count = 1;
  static constexpr bool remembers_normal = false;

  template <class T>
  using Size = std::array<T, 1>;

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
  static Touch<Dim, T> touch(std::array<T, 1> const& first, std::array<T, 1> const& second, Point<Dim, T> const& branch,
                             Point<Dim, T> const&) {
    return round_touch<Dim, T>(first[0], second[0], branch);
  }
};

}  // namespace scarp

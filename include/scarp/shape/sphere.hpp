// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <numbers>

#include "scarp/core/constant.hpp"
#include "scarp/core/pack.hpp"
#include "scarp/shape/particle_shape.hpp"

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

  /// Spheres whose centres coincide are parted along the first axis.
  template <class T>
  static Touch<3, T> touch(std::array<T, 1> const& first, std::array<T, 1> const& second, Point<3, T> const& branch,
                           Point<3, T> const&) {
    using std::sqrt;
    using std::experimental::where;
    T const distance = sqrt(branch[0] * branch[0] + branch[1] * branch[1] + branch[2] * branch[2]);
    auto const coincident = distance == constant<T>(0);
    T along = branch[0];
    T length = distance;
    where(coincident, along) = constant<T>(1);
    where(coincident, length) = constant<T>(1);
    T const inverse = constant<T>(1) / length;
    Point<3, T> const normal{along * inverse, branch[1] * inverse, branch[2] * inverse};
    T const overlap = first[0] + second[0] - distance;
    T const reach_first = first[0] - overlap * constant<T>(0.5);
    T const reach_second = second[0] - overlap * constant<T>(0.5);
    return {overlap,
            normal,
            {normal[0] * reach_first, normal[1] * reach_first, normal[2] * reach_first},
            {-normal[0] * reach_second, -normal[1] * reach_second, -normal[2] * reach_second}};
  }
};

static_assert(ParticleShape<Sphere>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <numbers>

#include "scarp/core/constant.hpp"
#include "scarp/shape/particle_shape.hpp"

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
    using std::sqrt;
    T const distance = sqrt(branch[0] * branch[0] + branch[1] * branch[1]);
    T const inverse = constant<T>(1) / distance;
    Point<2, T> const normal{branch[0] * inverse, branch[1] * inverse};
    T const overlap = first[0] + second[0] - distance;
    T const reach_first = first[0] - overlap * constant<T>(0.5);
    T const reach_second = second[0] - overlap * constant<T>(0.5);
    return {overlap,
            normal,
            {normal[0] * reach_first, normal[1] * reach_first},
            {-normal[0] * reach_second, -normal[1] * reach_second}};
  }
};

static_assert(ParticleShape<Disc>);

}  // namespace scarp

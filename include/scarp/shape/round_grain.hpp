// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

#include "scarp/shape/particle_shape.hpp"
#include "scarp/simd/pack.hpp"
#include "scarp/simd/select.hpp"

namespace scarp {

/// Where two discs or spheres meet, in the middle of their overlap. Those whose centres coincide are parted along the
/// first axis.
/// radii [m], branch from the first centre to the second [m]
template <int Dim, class T>
constexpr ContactGeometry<Dim, T> round_contact(T const& first, T const& second, Point<Dim, T> const& branch) {
  using std::sqrt;
  T squared = branch[0] * branch[0];
  for (std::size_t a = 1; a < branch.size(); ++a) squared = squared + branch[a] * branch[a];
  T const distance = sqrt(squared);
  auto const coincident = distance == broadcast<T>(0);
  T const inverse = broadcast<T>(1) / lanes::select(coincident, broadcast<T>(1), distance);
  ContactGeometry<Dim, T> touch;
  touch.overlap = first + second - distance;
  T const reach_first = first - touch.overlap * broadcast<T>(0.5);
  T const reach_second = second - touch.overlap * broadcast<T>(0.5);
  for (std::size_t a = 0; a < branch.size(); ++a) {
    T const along = a == 0 ? lanes::select(coincident, broadcast<T>(1), branch[0]) : branch[a];
    touch.normal[a] = along * inverse;
    touch.arm_first[a] = touch.normal[a] * reach_first;
    touch.arm_second[a] = -touch.normal[a] * reach_second;
  }
  return touch;
}

/// What discs and spheres have in common: a size that is their radius, and no orientation.
template <int Dim>
struct RoundGrain {
  static constexpr int dim = Dim;                    ///< 2 for discs, 3 for spheres
  static constexpr int size_count = 1;               ///< the radius
  static constexpr int orientation_count = 0;        ///< a turn changes nothing
  static constexpr int pose_count = 1;               ///< the radius
  static constexpr bool warm_starts_normal = false;  ///< the touch has a closed form

  template <class T>
  using Size = std::array<T, 1>;  ///< (radius) [m]

  static constexpr double bounding_radius(Size<double> const& size) { return size[0]; }  ///< The radius [m].
  static double eccentricity(Size<double> const&) { return 0.0; }  ///< Zero: the support function is constant.

  /// The radius [m]; there is no orientation.
  template <class T>
  static constexpr std::array<T, 1> pose(Size<T> const& size, std::array<T, 0> const&) {
    return size;
  }

  /// The radius [m].
  template <class T>
  static constexpr T contact_radius(std::array<T, 1> const& pose) {
    return pose[0];
  }

  /// By `round_contact` of the two radii; `branch` [m] joins the centres, a start normal is ignored.
  template <class T>
  static constexpr ContactGeometry<Dim, T> touch(std::array<T, 1> const& first, std::array<T, 1> const& second,
                                                 Point<Dim, T> const& branch, Point<Dim, T> const&) {
    return round_contact<Dim, T>(first[0], second[0], branch);
  }
};

}  // namespace scarp

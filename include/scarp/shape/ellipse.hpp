// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scarp/core/precompiled.hpp"
#include "scarp/shape/support_touch.hpp"

namespace scarp {

/// Elliptical grain in the plane; size is (semi-major a, semi-minor b), orientation (cos, sin) of the major axis.
/// The pose is the matrix of its support function, \f$ h(n)^2 = n \cdot A n,\; A = R\,diag(a^2, b^2) R^T \f$, as (xx, xy, yy).
struct Ellipse {
  static constexpr int dim = 2;
  static constexpr int size_count = 2;
  static constexpr int orientation_count = 2;
  static constexpr int pose_count = 3;
  static constexpr bool remembers_normal = true;

  template <class T>
  using Size = std::array<T, 2>;

  static double content(Size<double> const& size) { return std::numbers::pi * size[0] * size[1]; }
  static double gyration_squared(Size<double> const& size) { return (size[0] * size[0] + size[1] * size[1]) / 4.0; }
  static double bounding_radius(Size<double> const& size) { return std::max(size[0], size[1]); }
  static double eccentricity(Size<double> const& size) { return std::abs(size[0] - size[1]); }
  static double least_curvature_radius(Size<double> const& size) {
    double const longer = std::max(size[0], size[1]);
    double const shorter = std::min(size[0], size[1]);
    return shorter * shorter / longer;
  }

  template <class T>
  static std::array<T, 3> pose(Size<T> const& size, std::array<T, 2> const& orientation) {
    T const minor = size[1] * size[1];
    T const excess = size[0] * size[0] - minor;
    T const c = orientation[0];
    T const s = orientation[1];
    return {minor + excess * c * c, excess * c * s, minor + excess * s * s};
  }

  /// Radius of the circle of equal area, \f$ \sqrt{ab} = (\det A)^{1/4} \f$.
  template <class T>
  static T contact_radius(std::array<T, 3> const& pose) {
    using std::sqrt;
    return sqrt(sqrt(pose[0] * pose[2] - pose[1] * pose[1]));
  }

  /// Least radius of curvature b^2/a: a disc of that radius rolls along the inside of the boundary.
  static double inner_radius(std::array<double, 3> const& pose) {
    double const larger = (pose[0] + pose[2]) / 2.0 + std::hypot((pose[0] - pose[2]) / 2.0, pose[1]);
    return (pose[0] * pose[2] - pose[1] * pose[1]) / (larger * std::sqrt(larger));
  }

  template <class T>
  static Support<T> support(std::array<T, 3> const& pose, Point<2, T> const& normal) {
    using std::sqrt;
    Ray<T> const along = ray(pose, normal);
    T const value = sqrt(along.squared);
    return complete(along, value, constant<T>(1) / value);
  }

  /// Support functions of both grains of a pair along one normal; their divisions are shared.
  template <class T>
  static std::array<Support<T>, 2> supports(std::array<T, 3> const& first, std::array<T, 3> const& second,
                                            Point<2, T> const& normal) {
    using std::sqrt;
    Ray<T> const a = ray(first, normal);
    Ray<T> const b = ray(second, normal);
    T const value_a = sqrt(a.squared);
    T const value_b = sqrt(b.squared);
    T const inverse = constant<T>(1) / (value_a * value_b);
    return {complete(a, value_a, inverse * value_b), complete(b, value_b, inverse * value_a)};
  }

  template <class T>
  static Touch<2, T> touch(std::array<T, 3> const& first, std::array<T, 3> const& second, Point<2, T> const& branch,
                           Point<2, T> const& normal) {
    return support_touch<Ellipse>(first, second, branch, normal);
  }

 private:
  template <class T>
  struct Ray {
    T squared;      ///< h^2
    T slope;        ///< h dh/dphi
    T determinant;  ///< of A
  };

  template <class T>
  static Ray<T> ray(std::array<T, 3> const& pose, Point<2, T> const& normal) {
    T const x = pose[0] * normal[0] + pose[1] * normal[1];
    T const y = pose[1] * normal[0] + pose[2] * normal[1];
    return {x * normal[0] + y * normal[1], y * normal[0] - x * normal[1], pose[0] * pose[2] - pose[1] * pose[1]};
  }

  template <class T>
  static Support<T> complete(Ray<T> const& ray, T const& value, T const& inverse) {
    return {value, ray.slope * inverse, ray.determinant * inverse * inverse * inverse};
  }
};

static_assert(ParticleShape<Ellipse>);

template <>
inline constexpr bool is_precompiled<Ellipse> = detail::has_library;

}  // namespace scarp

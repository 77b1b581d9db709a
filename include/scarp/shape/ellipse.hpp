// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scarp/core/precompiled.hpp"
#include "scarp/shape/support_contact.hpp"
#include "scarp/simd/square_roots.hpp"

namespace scarp {

/// Elliptical grain in the plane; size is (semi-major a, semi-minor b), orientation (cos, sin) of the major axis.
/// The pose is the matrix of its support function, \f$ h(n)^2 = n \cdot A n,\; A = R\,diag(a^2, b^2) R^T \f$, as mean
/// and deviator,
/// \f$ A = [m + p,\ q;\ q,\ m - p] \f$.
struct Ellipse {
  static constexpr int dim = 2;                     ///< ellipses lie in a plane
  static constexpr int size_count = 2;              ///< two semi-axes
  static constexpr int orientation_count = 2;       ///< cosine and sine of the major axis
  static constexpr int pose_count = 3;              ///< m, p and q [m2] of the support matrix
  static constexpr bool is_point_symmetric = true;  ///< half a turn changes nothing
  static constexpr bool warm_starts_normal = true;  ///< a step of Newton's method starts from the stored normal

  template <class T>
  using Size = std::array<T, 2>;  ///< (a, b), semi-axes [m]

  /// Area \f$ \pi a b \f$ [m2].
  static double content(Size<double> const& size) { return std::numbers::pi * size[0] * size[1]; }
  /// Polar second moment about the centre over the area, \f$ (a^2 + b^2)/4 \f$ [m2].
  static double gyration_squared(Size<double> const& size) { return (size[0] * size[0] + size[1] * size[1]) / 4.0; }
  /// The longer semi-axis [m].
  static constexpr double bounding_radius(Size<double> const& size) { return std::max(size[0], size[1]); }
  /// Largest slope of the support function, \f$ |a - b| \f$ [m] per radian.
  static double eccentricity(Size<double> const& size) { return std::abs(size[0] - size[1]); }

  /// (m, p, q) [m2]; the deviator (p, q) turns by twice the angle of the major axis.
  template <class T>
  static constexpr std::array<T, 3> pose(Size<T> const& size, std::array<T, 2> const& orientation) {
    T const major = size[0] * size[0];
    T const minor = size[1] * size[1];
    T const c = orientation[0];
    T const s = orientation[1];
    T const deviator = broadcast<T>(0.5) * (major - minor);
    return {broadcast<T>(0.5) * (major + minor), deviator * (c * c - s * s), deviator * (c * s + c * s)};
  }

  /// Radius of the circle of equal area, \f$ \sqrt{ab} = (\det A)^{1/4} \f$.
  template <class T>
  static constexpr T contact_radius(std::array<T, 3> const& pose) {
    using std::sqrt;
    return sqrt(sqrt(pose[0] * pose[0] - pose[1] * pose[1] - pose[2] * pose[2]));
  }

  /// Least radius of curvature b^2/a: a disc of that radius rolls along the inside of the boundary.
  static constexpr double inner_radius(std::array<double, 3> const& pose) {
    double const deviator = std::sqrt(pose[1] * pose[1] + pose[2] * pose[2]);
    return (pose[0] - deviator) / std::sqrt(pose[0] + deviator);
  }

  /// Support function of one grain along a unit normal: value, slope and radius of curvature [m].
  template <class T>
  static constexpr Support<T> support(std::array<T, 3> const& pose, Point<2, T> const& normal) {
    return supports(pose, pose, normal)[0];
  }

  /// Support functions of both grains of a pair along one unit normal.
  template <class T>
  static constexpr std::array<Support<T>, 2> supports(std::array<T, 3> const& first, std::array<T, 3> const& second,
                                                      Point<2, T> const& normal) {
    T const product = normal[0] * normal[1];
    Point<2, T> const doubled{normal[0] * normal[0] - normal[1] * normal[1], product + product};
    Ray<T> const a = ray(first, doubled);
    Ray<T> const b = ray(second, doubled);
    auto const roots = lanes::square_roots(a.squared, b.squared);
    return {complete(a, roots[0]), complete(b, roots[1])};
  }

  /// One step of Newton's method for a pair, by `support_contact`; `branch` [m], `normal` the unit vector to start
  /// from.
  template <class T>
  static constexpr ContactGeometry<2, T> touch(std::array<T, 3> const& first, std::array<T, 3> const& second,
                                               Point<2, T> const& branch, Point<2, T> const& normal) {
    return support_contact<Ellipse>(first, second, branch, normal);
  }

 private:
  template <class T>
  struct Ray {
    T squared;  ///< h^2
    T slope;    ///< h dh/dphi
    T across;   ///< square of h a quarter turn on
  };

  /// Along the normal whose angle is half that of the unit vector `doubled`.
  template <class T>
  static constexpr Ray<T> ray(std::array<T, 3> const& pose, Point<2, T> const& doubled) {
    T const along = pose[1] * doubled[0] + pose[2] * doubled[1];
    return {pose[0] + along, pose[2] * doubled[0] - pose[1] * doubled[1], pose[0] - along};
  }

  /// \f$ h + h'' = (h_\perp^2 - h'^2)/h \f$
  template <class T>
  static constexpr Support<T> complete(Ray<T> const& ray, lanes::SquareRoot<T> const& h) {
    T const slope = ray.slope * h.inverse;
    return {h.value, slope, (ray.across - slope * slope) * h.inverse};
  }
};

static_assert(ParticleShape<Ellipse>);

/// Ellipses are among the shapes of `scarp::precompiled`.
template <>
inline constexpr bool is_precompiled<Ellipse> = detail::has_library;

}  // namespace scarp

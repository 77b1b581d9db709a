// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scarp/core/error.hpp"
#include "scarp/shape/superellipse_contact.hpp"
#include "scarp/simd/pack.hpp"

namespace scarp {

/// Superelliptical grain in the plane, \f$ |x/r_x|^{2/\epsilon} + |y/r_y|^{2/\epsilon} = 1 \f$; size is (half axis rx,
/// half axis ry, exponent eps), orientation (cos, sin) of the rx axis. An exponent of 1 is an ellipse, towards 0 a
/// rectangle, towards 2 a rhombus.
/// \f$ h(n) = (|r_x n_x|^q + |r_y n_y|^q)^{1/q},\; q = 2/(2-\epsilon) \f$ is its support function.
/// The pose is (cos, sin, rx, ry, q - 1, 1/q, 1/(q - 1)).
struct Superellipse {
  static constexpr int dim = 2;                     ///< superellipses lie in a plane
  static constexpr int size_count = 3;              ///< two half axes and the exponent
  static constexpr int orientation_count = 2;       ///< cosine and sine of the rx axis
  static constexpr int pose_count = 7;              ///< numbers of `Pose`
  static constexpr bool is_point_symmetric = true;  ///< half a turn changes nothing
  static constexpr bool warm_starts_normal = true;  ///< the search starts from the stored normal
  static constexpr double smallest_exponent = 0.2;  ///< the contact search holds from this value on
  static constexpr double largest_exponent = 1.8;   ///< the contact search holds up to this value

  template <class T>
  using Size = std::array<T, 3>;  ///< (rx, ry, eps): half axes [m] and the exponent, without unit
  template <class T>
  using Pose = std::array<T, 7>;  ///< (cos, sin, rx, ry, q - 1, 1/q, 1/(q - 1)), half axes in [m]

  /// \throws InputError unless the half axes are positive and the exponent lies in the range that the touch is made for
  static void check(Size<double> const& size) {
    require_positive("half axis rx of a superellipse", size[0]);
    require_positive("half axis ry of a superellipse", size[1]);
    if (!(size[2] >= smallest_exponent && size[2] <= largest_exponent)) {
      reject("exponent of a superellipse is {} (contact search holds between {} and {}): choose one in that range",
             size[2], smallest_exponent, largest_exponent);
    }
  }

  /// \f$ 2 r_x r_y \epsilon\, B(\epsilon/2, \epsilon/2 + 1) \f$
  static double content(Size<double> const& size) {
    auto const [rx, ry, eps] = size;
    return 2.0 * rx * ry * eps * std::tgamma(eps / 2.0) * std::tgamma(eps / 2.0 + 1.0) / std::tgamma(eps + 1.0);
  }

  /// From \f$ \int x^2 = r_x^3 r_y\,\epsilon\, B(3\epsilon/2, \epsilon/2) / 2 \f$ and its like in y.
  static double gyration_squared(Size<double> const& size) {
    auto const [rx, ry, eps] = size;
    return (rx * rx + ry * ry) * std::tgamma(1.5 * eps) * std::tgamma(eps + 1.0) /
           (std::tgamma(eps / 2.0) * std::tgamma(2.0 * eps + 1.0));
  }

  /// At a corner where the exponent is below one, on the longer axis otherwise.
  static constexpr double bounding_radius(Size<double> const& size) {
    double const longer = std::max(size[0], size[1]);
    double const aspect = std::min(size[0], size[1]) / longer;
    double const bulge = 1.0 - size[2];
    return bulge > 0.0 ? longer * std::pow(1.0 + std::pow(aspect, 2.0 / bulge), bulge / 2.0) : longer;
  }

  /// Largest slope of the support function over a quarter of the boundary [m] per radian, to about 1e-7 of it: the best
  /// of a grid, then golden sections about it.
  static double eccentricity(Size<double> const& size) {
    auto const shape = pose<double>(size, {1.0, 0.0});
    // Even steps of Barr's parameter follow the boundary where steps of the normal's angle leap over corners or flats.
    auto const at = [&](double parameter) {
      double const x = std::pow(std::cos(parameter), 2.0 - size[2]) / size[0];
      double const y = std::pow(std::sin(parameter), 2.0 - size[2]) / size[1];
      double const length = std::hypot(x, y);
      return std::abs(support<double>(shape, {x / length, y / length}).slope);
    };
    constexpr int steps = 64;
    constexpr double step = std::numbers::pi / 2.0 / steps;
    int best = 1;
    for (int k = 2; k < steps; ++k) {
      if (at(k * step) > at(best * step)) best = k;
    }
    double low = (best - 1) * step;
    double high = (best + 1) * step;
    constexpr double section = 1.0 / std::numbers::phi;
    for (int k = 0; k < 30; ++k) {
      double const left = high - section * (high - low);
      double const right = low + section * (high - low);
      (at(left) > at(right) ? high : low) = at(left) > at(right) ? right : left;
    }
    return at((low + high) / 2.0);
  }

  /// From half axes [m], exponent and axis of one grain; `q` follows from the exponent.
  template <class T>
  static constexpr Pose<T> pose(Size<T> const& size, std::array<T, 2> const& orientation) {
    T const inverse = broadcast<T>(1) - size[2] * broadcast<T>(0.5);
    T const flat = size[2] * broadcast<T>(0.5) / inverse;
    return {orientation[0], orientation[1], size[0], size[1], flat, inverse, broadcast<T>(1) / flat};
  }

  /// Geometric mean of the half axes.
  template <class T>
  static constexpr T contact_radius(Pose<T> const& pose) {
    using std::sqrt;
    return sqrt(pose[2] * pose[3]);
  }

  /// Support function of one grain along a unit normal: value, slope and radius of curvature [m].
  template <class T>
  static constexpr SuperellipseSupport<T> support(Pose<T> const& pose, Point<2, T> const& normal) {
    return superellipse_supports<T, 1>({pose}, normal)[0];
  }

  /// By `superellipse_contact`: `branch` [m] joins the centres, `normal` is where the search starts.
  template <class T>
  static constexpr ContactGeometry<2, T> touch(Pose<T> const& first, Pose<T> const& second, Point<2, T> const& branch,
                                               Point<2, T> const& normal) {
    return superellipse_contact(first, second, branch, normal);
  }
};

static_assert(ParticleShape<Superellipse>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "scarp/core/error.hpp"
#include "scarp/shape/support_contact.hpp"

namespace scarp {

/// What follows from the support function h of a convex plane grain by sums over 1024 normals: integrals to round-off
/// where h is smooth (periodic trapezoidal rule), largest values to a millionth (parabola through three of them).
struct SupportIntegrals {
  double content = 0.0;           ///< area, \f$ \int h (h + h'') / 2\,d\phi \f$ [m2]
  double gyration_squared = 0.0;  ///< polar moment about the centre over the area [m2]
  double off_centre = 0.0;        ///< distance of the centroid from the centre [m]
  double bounding_radius = 0.0;   ///< largest h [m]
  double eccentricity = 0.0;      ///< largest change of h per radian [m]
  double inner_radius =
      0.0;  ///< least radius of curvature, \f$ h + h'' \f$ [m]; negative where the grain is not convex

  /// support(normal): `Support<double>` of the grain along a unit normal
  template <class SupportOf>
  static SupportIntegrals of(SupportOf const& support) {
    constexpr int count = 1024;
    constexpr double step = 2.0 * std::numbers::pi / count;
    std::array<double, count> heights, slopes;
    SupportIntegrals sums{.inner_radius = std::numeric_limits<double>::infinity()};
    Point<2, double> centroid{};
    for (int k = 0; k < count; ++k) {
      double const cosine = std::cos(step * k), sine = std::sin(step * k);
      Support<double> const h = support(Point<2, double>{cosine, sine});
      double const part = h.value * h.curvature_radius * step / 2.0;  // triangle from the centre to the boundary
      double const square = h.value * h.value + h.slope * h.slope;    // of the distance of the boundary
      sums.content += part;
      sums.gyration_squared += part * square / 2.0;
      centroid[0] += part * 2.0 / 3.0 * (h.value * cosine - h.slope * sine);
      centroid[1] += part * 2.0 / 3.0 * (h.value * sine + h.slope * cosine);
      sums.inner_radius = std::min(sums.inner_radius, h.curvature_radius);
      heights[static_cast<std::size_t>(k)] = h.value;
      slopes[static_cast<std::size_t>(k)] = std::abs(h.slope);
    }
    sums.gyration_squared /= sums.content;
    sums.off_centre = std::hypot(centroid[0], centroid[1]) / sums.content;
    sums.bounding_radius = peak(heights);
    sums.eccentricity = peak(slopes);
    return sums;
  }

 private:
  template <class Values>
  static double peak(Values const& values) {
    auto const count = values.size();
    auto const best = static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
    double const before = values[(best + count - 1) % count], top = values[best], after = values[(best + 1) % count];
    double const bend = before - 2.0 * top + after;
    return bend < 0.0 ? top - (after - before) * (after - before) / (8.0 * bend) : top;
  }
};

namespace detail {

/// Compares a shape's closed forms with its support function, where it has one by `supports(pose, pose, normal)`.
/// \throws InputError that names the form which differs by more than a hundredth
template <class Shape>
void require_closed_forms(SizeOf<Shape> const& size) {
  if constexpr (Shape::dim == 2 && Shape::orientation_count == 2 &&
                requires(PoseOf<Shape> const& pose) { Shape::supports(pose, pose, Point<2, double>{}); }) {
    PoseOf<Shape> const pose = part_pose<Shape>(size, std::array{1.0, 0.0}, 0);
    auto const sums = SupportIntegrals::of([&](auto const& normal) { return Shape::supports(pose, pose, normal)[0]; });
    // slight [m]: of a length that may be zero
    auto const require = [&](std::string_view what, double given, double found, double slight = 0.0) {
      if (std::abs(given - found) <= 0.01 * std::abs(found) + slight) return;
      reject("{} of a grain of size {} is {:.6g} (its support function has {:.6g}): correct the one or the other", what,
             size[0], given, found);
    };
    require("content", Shape::content(size), sums.content);
    require("radius of gyration", std::sqrt(Shape::gyration_squared(size)), std::sqrt(sums.gyration_squared));
    require("bounding radius", Shape::bounding_radius(size), sums.bounding_radius);
    require("eccentricity", Shape::eccentricity(size), sums.eccentricity, 1e-6 * sums.bounding_radius);
  }
}

}  // namespace detail

}  // namespace scarp

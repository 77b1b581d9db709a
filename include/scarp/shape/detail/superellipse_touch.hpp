// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/core/constant.hpp"
#include "scarp/core/positive_power.hpp"
#include "scarp/core/select.hpp"
#include "scarp/shape/support_touch.hpp"

namespace scarp {

/// Support function, and where the normal stands among the grain's axes: `tilt` is the tangent of its angle from the
/// nearest one (that of larger r |n|), never zero. The slope is there nearly linear in the tilt to the power 1 / bend.
template <class T>
struct SuperellipseSupport : Support<T> {
  T tilt;
  T bend;
};

/// pose: (cos, sin, rx, ry, q, 1/q) of \f$ h(n) = (|r_x n_x|^q + |r_y n_y|^q)^{1/q} \f$
template <class T>
SuperellipseSupport<T> superellipse_support(std::array<T, 6> const& pose, Point<2, T> const& normal) {
  using std::abs;
  using std::copysign;
  using std::max;
  using std::min;
  auto const& [c, s, rx, ry, q, inverse_q] = pose;
  T const one = constant<T>(1);
  T const nx = c * normal[0] + s * normal[1];
  T const ny = c * normal[1] - s * normal[0];
  T const u = rx * abs(nx);
  T const v = ry * abs(ny);
  auto const nearer_y = v > u;
  T const large = max(u, v);
  // Divisions are what takes the time: several quotients come from one.
  T const flat = q - one;
  T const along = lanes::select(nearer_y, rx, ry);
  T const beside = lanes::select(nearer_y, ry, rx);
  T const all = one / (large * along * flat);
  T const inverse_large = all * (along * flat);
  // The floor keeps the radius of curvature of a flat side finite; such an angle is below the resolution of a normal.
  T const ratio = max(min(u, v) * inverse_large, constant<T>(1e-18));
  T const power = lanes::positive_power(ratio, q);
  T const sum = one + power;
  T const root = lanes::positive_power(sum, inverse_q);

  // Gradient of the norm; its larger component is root / sum.
  T const both = one / (sum * ratio);
  T const inverse_sum = both * ratio;
  T const steep = power * (both * sum);  // ratio to the power q - 1
  T share_x = root * inverse_sum;
  T share_y = share_x * steep;
  T const angle = copysign(ratio, nx * ny) * beside * (all * (large * flat));
  T const swapped = share_x;
  share_x = lanes::select(nearer_y, share_y, share_x);
  share_y = lanes::select(nearer_y, swapped, share_y);
  T const tangent = lanes::select(nearer_y, -angle, angle);
  T const x = rx * copysign(share_x, nx);
  T const y = ry * copysign(share_y, ny);

  T const spread = rx * ry * inverse_large;
  T const bent = steep * (both * sum) * root * (inverse_sum * inverse_sum);
  T const curvature_radius = flat * spread * spread * inverse_large * bent;
  return {{large * root, nx * y - ny * x, curvature_radius}, tangent, max(all * (large * along), one)};
}

/// Touch of two superellipses: Newton steps for the normal n that minimises
/// \f$ f(\phi) = h_A(n) + h_B(n) - d \cdot n \f$ until the step left is small, then overlap and arms by their
/// expansions as in `support_touch`. A pair that rests or moves slowly takes one evaluation.
///
/// Near a flat side f' runs like a power \f$ \psi^{q-1} \f$ of the angle from the side's normal, where Newton's method
/// leaps back and forth. The step is therefore one in that power of the angle, for the grain of larger radius of
/// curvature. A bracket about a minimum, bisected when steps leave it or leap from side to side, guards corners, where
/// radii of curvature vanish. Corners that meet head-on may have two minima: the one downhill from the start is
/// followed.
/// `normal` is where to start; one of no use (zero, or not ahead of the branch) is replaced by the branch.
template <class T>
Touch<2, T> superellipse_touch(std::array<T, 6> const& first, std::array<T, 6> const& second, Point<2, T> const& branch,
                               Point<2, T> const& normal) {
  using std::abs;
  using std::copysign;
  using std::max;
  using std::min;
  using std::sqrt;
  constexpr int most_evaluations = 40;
  constexpr double largest_step = 0.5;  // radians
  constexpr double small_step = 1e-4;   // radians; the expansions' error in the normal is of second order in it
  constexpr double resolution = std::numeric_limits<typename ScalarOf<T>::type>::epsilon();
  constexpr double small_gain = std::max(1e-10, 2.0 * resolution);  // of overlap, relative to the grains
  constexpr double farthest_turn = 0.05;                            // tangent of half the angle from the start
  constexpr double deep = 0.1;                                      // of the grains' size
  T const one = constant<T>(1);
  T const half = constant<T>(0.5);

  // Shapes symmetric about their centres overlap least in a direction ahead of the branch.
  Point<2, T> start = normal;
  auto const astray = normal[0] * branch[0] + normal[1] * branch[1] < constant<T>(0) ||
                      normal[0] * normal[0] + normal[1] * normal[1] < constant<T>(0.25);
  start[0] = lanes::select(astray, branch[0], start[0]);
  start[1] = lanes::select(astray, branch[1], start[1]);
  T const inverse_length = one / sqrt(start[0] * start[0] + start[1] * start[1]);
  for (T& component : start) component *= inverse_length;
  // A rotation by the angle whose half has this tangent.
  auto const turned = [&](Point<2, T> const& from, T const& half_tangent) {
    T const scale = one / (one + half_tangent * half_tangent);
    T const cosine = (one - half_tangent * half_tangent) * scale;
    T const sine = constant<T>(2) * half_tangent * scale;
    return Point<2, T>{cosine * from[0] - sine * from[1], sine * from[0] + cosine * from[1]};
  };

  T at = constant<T>(0);
  T low = -one;
  T high = one;
  T slope_before = constant<T>(0);
  for (int evaluation = 1;; ++evaluation) {
    Point<2, T> const n = turned(start, at);
    Point<2, T> const t{-n[1], n[0]};
    auto const a = superellipse_support(first, n);
    auto const b = superellipse_support(second, n);
    T const depth = a.value + b.value - (branch[0] * n[0] + branch[1] * n[1]);
    T const slope = a.slope + b.slope - (branch[0] * t[0] + branch[1] * t[1]);
    T const radii = a.curvature_radius + b.curvature_radius;
    T const size = a.value + b.value;
    T const stiffness = max(max(radii - depth, radii * constant<T>(0.25)), size * constant<T>(1e-12));
    T const newton = -slope / stiffness;

    T tilt = a.tilt;
    T bend = a.bend;
    tilt = lanes::select(b.curvature_radius > a.curvature_radius, b.tilt, tilt);
    bend = lanes::select(b.curvature_radius > a.curvature_radius, b.bend, bend);
    T const swing = newton / (tilt * bend);
    T step = newton;
    auto const bends = bend > one && abs(swing) > constant<T>(1e-3);
    if (lanes::any_of(bends)) {
      T const stretch = one + swing;
      T const size_of_stretch = max(abs(stretch), constant<T>(1e-18));
      step = lanes::select(bends, tilt * (copysign(lanes::positive_power(size_of_stretch, bend), stretch) - one), step);
    }
    step = max(min(step, constant<T>(largest_step)), constant<T>(-largest_step));

    auto const rough = abs(step) > constant<T>(small_step) || abs(step * slope) > constant<T>(small_gain) * size;
    if (evaluation == most_evaluations || lanes::none_of(rough)) {
      T const overlap = depth + half * slope * step;
      T const shift = half * (a.slope - b.slope + newton * (a.curvature_radius - b.curvature_radius));
      T const level = half * (a.value - b.value);
      Point<2, T> const middle{half * branch[0] + level * n[0] + shift * t[0],
                               half * branch[1] + level * n[1] + shift * t[1]};
      // Far from the start, or deep inside, another corner may be the nearer one.
      auto const doubtful = rough || abs(at) > constant<T>(farthest_turn) || overlap > constant<T>(deep) * size;
      T const unsettled = lanes::select(doubtful, constant<T>(std::numeric_limits<double>::infinity()), constant<T>(0));
      return {overlap, turned(n, half * step), middle, {middle[0] - branch[0], middle[1] - branch[1]}, unsettled};
    }
    high = lanes::select(slope > constant<T>(0), at, high);
    low = lanes::select(!(slope > constant<T>(0)), at, low);
    T next = (at + half * step) / (one - at * half * step);
    auto const leaps = slope * slope_before < -half * slope_before * slope_before;
    next = lanes::select(leaps || !(next > low && next < high), half * (low + high), next);
    slope_before = slope;
    at = lanes::select(rough, next, at);
  }
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/shape/support_contact.hpp"
#include "scarp/simd/pack.hpp"
#include "scarp/simd/positive_power.hpp"
#include "scarp/simd/select.hpp"

namespace scarp {

/// Support function, and where the normal stands among the grain's axes: `tilt` is the tangent of its angle from the
/// nearest one (that of larger r |n|), never zero. The slope is there nearly linear in the tilt to the power 1 / bend.
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <class T>
struct SuperellipseSupport : Support<T> {
  T tilt;  ///< tangent of the normal's angle from the nearest axis, signed
  T bend;  ///< 1/(q - 1), at least one
};

/// The normal among a superellipse's axes: `along` is the half axis nearer to it (of larger r |n|), `beside` the other
/// one.
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <class T>
struct SuperellipseFrame {
  T along;          ///< half axis [m]
  T beside;         ///< half axis [m]
  T normal_along;   ///< |n|
  T normal_beside;  ///< |n|
  T turn;           ///< its sign is that of the angle from the nearer axis
  T large;          ///< r |n|
  T inverse_large;  ///< 1 / large [1/m]
  T inverse_along;  ///< 1 / along [1/m]
  T ratio;          ///< the smaller r |n| over the larger one

  constexpr SuperellipseFrame() = default;
  /// pose: (cos, sin, rx, ry, q - 1, 1/q, 1/(q - 1)) with half axes in [m]; `normal` a unit vector in the frame of
  /// space
  constexpr SuperellipseFrame(std::array<T, 7> const& pose, Point<2, T> const& normal) {
    using std::abs;
    using std::max;
    using std::min;
    T const nx = pose[0] * normal[0] + pose[1] * normal[1];
    T const ny = pose[0] * normal[1] - pose[1] * normal[0];
    T const u = pose[2] * abs(nx);
    T const v = pose[3] * abs(ny);
    auto const nearer_y = v > u;
    along = lanes::select(nearer_y, pose[3], pose[2]);
    beside = lanes::select(nearer_y, pose[2], pose[3]);
    normal_along = lanes::select(nearer_y, abs(ny), abs(nx));
    normal_beside = lanes::select(nearer_y, abs(nx), abs(ny));
    turn = lanes::select(nearer_y, -(nx * ny), nx * ny);
    large = max(u, v);
    // Divisions are slow: several quotients come from one.
    T const inverse = broadcast<T>(1) / (large * along);
    inverse_large = inverse * along;
    inverse_along = inverse * large;
    // The floor keeps the radius of curvature of a flat side finite; such an angle is below the resolution of a normal.
    ratio = max(min(u, v) * inverse_large, broadcast<T>(1e-18));
  }
};

/// Support functions of several grains along one normal, their powers side by side.
/// poses: (cos, sin, rx, ry, q - 1, 1/q, 1/(q - 1)) of \f$ h(n) = (|r_x n_x|^q + |r_y n_y|^q)^{1/q} \f$
template <class T, std::size_t Count>
constexpr std::array<SuperellipseSupport<T>, Count> superellipse_supports(
    std::array<std::array<T, 7>, Count> const& poses, Point<2, T> const& normal) {
  using std::copysign;
  using std::max;
  T const one = broadcast<T>(1);
  std::array<SuperellipseFrame<T>, Count> frames;
  std::array<T, Count> base;
  std::array<T, Count> exponent;
  for (std::size_t k = 0; k < Count; ++k) {
    frames[k] = SuperellipseFrame<T>(poses[k], normal);
    base[k] = frames[k].ratio;
    exponent[k] = poses[k][4];
  }
  auto const steep = lanes::positive_powers(base, exponent);
  for (std::size_t k = 0; k < Count; ++k) {
    base[k] = one + steep[k] * frames[k].ratio;
    exponent[k] = poses[k][5];
  }
  auto const root = lanes::small_powers(base, exponent);

  std::array<SuperellipseSupport<T>, Count> supports;
  for (std::size_t k = 0; k < Count; ++k) {
    auto const& frame = frames[k];
    T const both = one / (base[k] * frame.ratio);
    T const inverse_sum = both * frame.ratio;
    T const share = root[k] * inverse_sum;  // the larger component of the norm's gradient
    T const across = frame.normal_along * (frame.beside * steep[k]) - frame.normal_beside * frame.along;
    T const spread = frame.along * frame.beside * frame.inverse_large;
    T const bent = (both * base[k]) * (share * inverse_sum) * steep[k];
    supports[k] = {{frame.large * root[k], copysign(share, frame.turn) * across,
                    (poses[k][4] * frame.inverse_large) * (spread * spread) * bent},
                   copysign(frame.ratio * frame.beside * frame.inverse_along, frame.turn),
                   max(poses[k][6], one)};
  }
  return supports;
}

/// Touch of two superellipses: Newton steps for the normal n that minimises
/// \f$ f(\phi) = h_A(n) + h_B(n) - d \cdot n \f$ until the step left is small, then overlap and arms by their
/// expansions as in `support_contact`. A pair at rest or in slow motion requires one evaluation.
///
/// Near a flat side f' runs like a power \f$ \psi^{q-1} \f$ of the angle from the side's normal, where Newton's method
/// leaps back and forth. The step is therefore one in that power of the angle, for the grain of larger radius of
/// curvature. A bracket about a minimum, bisected when steps leave it or leap from side to side, guards corners, where
/// radii of curvature vanish. Corners that meet head-on may have two minima: the one downhill from the start is
/// followed.
/// `normal` is where to start; one of no use (zero, or not ahead of the branch) is replaced by the branch.
template <class T>
constexpr ContactGeometry<2, T> superellipse_contact(std::array<T, 7> const& first, std::array<T, 7> const& second,
                                                     Point<2, T> const& branch, Point<2, T> const& normal) {
  using std::abs;
  using std::copysign;
  using std::max;
  using std::min;
  using std::sqrt;
  constexpr int max_evaluations = 40;
  constexpr double largest_step = 0.5;  // radians
  constexpr double small_step = 1e-4;   // radians; the expansions' error in the normal is of second order in it
  constexpr double resolution = std::numeric_limits<typename ScalarOf<T>::type>::epsilon();
  constexpr double small_gain = std::max(1e-10, 2.0 * resolution);  // of overlap, relative to the grains
  constexpr double farthest_turn = 0.05;                            // tangent of half the angle from the start
  constexpr double deep = 0.1;                                      // of the grains' size
  T const one = broadcast<T>(1);
  T const half = broadcast<T>(0.5);

  // Shapes symmetric about their centres overlap least in a direction ahead of the branch.
  Point<2, T> start = normal;
  T const squared = normal[0] * normal[0] + normal[1] * normal[1];
  auto const astray = normal[0] * branch[0] + normal[1] * branch[1] < broadcast<T>(0) || squared < broadcast<T>(0.25);
  // A stored normal is a unit vector to round-off, and stays one by a step of Newton's method for 1 / sqrt.
  T inverse_length = broadcast<T>(1.5) - half * squared;
  if (lanes::any_of(astray || abs(squared - one) > broadcast<T>(1e-7))) {
    start[0] = lanes::select(astray, branch[0], start[0]);
    start[1] = lanes::select(astray, branch[1], start[1]);
    inverse_length = one / sqrt(start[0] * start[0] + start[1] * start[1]);
  }
  for (T& component : start) component *= inverse_length;
  // A rotation by the angle whose half has this tangent.
  auto const turned = [&](Point<2, T> const& from, T const& half_tangent) {
    T const scale = one / (one + half_tangent * half_tangent);
    T const cosine = (one - half_tangent * half_tangent) * scale;
    T const sine = broadcast<T>(2) * half_tangent * scale;
    return Point<2, T>{cosine * from[0] - sine * from[1], sine * from[0] + cosine * from[1]};
  };

  T at = broadcast<T>(0);
  T low = -one;
  T high = one;
  T slope_before = broadcast<T>(0);
  Point<2, T> n = start;
  for (int evaluation = 1;; ++evaluation) {
    Point<2, T> const t{-n[1], n[0]};
    auto const [a, b] = superellipse_supports<T, 2>({first, second}, n);
    T const depth = a.value + b.value - (branch[0] * n[0] + branch[1] * n[1]);
    T const slope = a.slope + b.slope - (branch[0] * t[0] + branch[1] * t[1]);
    T const radii = a.curvature_radius + b.curvature_radius;
    T const size = a.value + b.value;
    T const stiffness = max(max(radii - depth, radii * broadcast<T>(0.25)), size * broadcast<T>(1e-12));
    auto const second_is_flatter = b.curvature_radius > a.curvature_radius;
    T const tilt = lanes::select(second_is_flatter, b.tilt, a.tilt);
    T const bend = lanes::select(second_is_flatter, b.bend, a.bend);
    T const bent_tilt = tilt * bend;
    T const swing = -slope / (stiffness * bent_tilt);
    T const newton = swing * bent_tilt;
    // tilt ((1 + swing)^bend - 1), by its series where the swing is small: the next term is below 4e-3 of the step.
    T step = newton * (one + swing * (bend - one) * half *
                                 (one + swing * (bend - broadcast<T>(2)) * broadcast<T>(1.0 / 3.0) *
                                            (one + swing * (bend - broadcast<T>(3)) * broadcast<T>(0.25))));
    auto const swings = bend > one && abs(swing) > broadcast<T>(0.125);
    if (lanes::any_of(swings)) {
      T const stretch = one + swing;
      T const size_of_stretch = max(abs(stretch), broadcast<T>(1e-18));
      step =
          lanes::select(swings, tilt * (copysign(lanes::positive_power(size_of_stretch, bend), stretch) - one), step);
    }
    step = max(min(step, broadcast<T>(largest_step)), broadcast<T>(-largest_step));

    auto const rough = abs(step) > broadcast<T>(small_step) || abs(step * slope) > broadcast<T>(small_gain) * size;
    if (evaluation == max_evaluations || lanes::none_of(rough)) {
      T const overlap = depth + half * slope * step;
      T const shift = half * (a.slope - b.slope + newton * (a.curvature_radius - b.curvature_radius));
      T const level = half * (a.value - b.value);
      Point<2, T> const middle{half * branch[0] + level * n[0] + shift * t[0],
                               half * branch[1] + level * n[1] + shift * t[1]};
      // A unit vector to step^4, which is round-off unless the normal has not converged.
      T const shrink = one - half * step * step;
      Point<2, T> const last{(n[0] + step * t[0]) * shrink, (n[1] + step * t[1]) * shrink};
      // Far from the start, or deep inside, another corner may be the nearer one.
      auto const doubtful = rough || abs(at) > broadcast<T>(farthest_turn) || overlap > broadcast<T>(deep) * size;
      T const normal_error =
          lanes::select(doubtful, broadcast<T>(std::numeric_limits<double>::infinity()), broadcast<T>(0));
      return {overlap, last, middle, {middle[0] - branch[0], middle[1] - branch[1]}, normal_error};
    }
    high = lanes::select(slope > broadcast<T>(0), at, high);
    low = lanes::select(!(slope > broadcast<T>(0)), at, low);
    T next = (at + half * step) / (one - at * half * step);
    auto const leaps = slope * slope_before < -half * slope_before * slope_before;
    next = lanes::select(leaps || !(next > low && next < high), half * (low + high), next);
    slope_before = slope;
    at = lanes::select(rough, next, at);
    n = turned(start, at);
  }
}

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>

#include "scarp/core/host_device.hpp"
#include "scarp/shape/particle_shape.hpp"
#include "scarp/simd/pack.hpp"
#include "scarp/simd/select.hpp"

namespace scarp {

/// Support function of a convex, centrally symmetric plane shape along a unit normal n(phi): value h [m], slope
/// dh/dphi [m] and radius of curvature h + d2h/dphi2 [m] of the boundary at the support point.
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <class T>
struct Support {
  T value;             ///< distance of the tangent line from the centre [m]
  T slope;             ///< derivative by the normal's angle [m] per radian
  T curvature_radius;  ///< of the boundary where the tangent line touches [m]
};

/// One Newton step for the normal n that minimises \f$ f(\phi) = h_A(n) + h_B(n) - d \cdot n \f$, from a given start.
/// \f$ f'' = \rho_A + \rho_B - f \f$. Overlap and arms are carried to the new normal by their own expansions, so that
/// one evaluation serves both: error in the normal is second order in the correction, in the overlap third order, and
/// both vanish at rest. Repeat with the returned normal until it stands still for a new pair; `normal_error` is the
/// angle of the step. branch d [m] from the first centre to the second; `normal` a unit vector
template <class Shape, class Pose, class T>
SCARP_DEVICE_CONSTEXPR ContactGeometry<2, T> support_contact(Pose const& first, Pose const& second,
                                                             Point<2, T> const& branch, Point<2, T> const& normal) {
  using std::abs;
  Point<2, T> const tangent{-normal[1], normal[0]};
  auto const [a, b] = Shape::supports(first, second, normal);
  T const along = branch[0] * normal[0] + branch[1] * normal[1];
  T const across = branch[0] * tangent[0] + branch[1] * tangent[1];
  T const depth = a.value + b.value - along;
  T const slope = a.slope + b.slope - across;
  T const curvature = a.curvature_radius + b.curvature_radius - depth;
  T const largest_turn = broadcast<T>(0.5);  // radians; keeps a poor start from overshooting
  T const turn = lanes::at_least(lanes::at_most(-slope / curvature, largest_turn), -largest_turn);

  // 1/sqrt(1 + excess) by its series: the stored normal is a unit vector and turns little in a step; a poor start of a
  // new pair becomes one while the touch is iterated.
  T const excess = (normal[0] * normal[0] + normal[1] * normal[1]) * (broadcast<T>(1) + turn * turn) - broadcast<T>(1);
  T const shrink = broadcast<T>(1) - excess * (broadcast<T>(0.5) - excess * broadcast<T>(0.375));
  Point<2, T> const turned{(normal[0] + turn * tangent[0]) * shrink, (normal[1] + turn * tangent[1]) * shrink};
  T const overlap = depth + broadcast<T>(0.5) * slope * turn;
  // Support points: h n + h' t, which move along t by the radius of curvature per radian.
  T const half = broadcast<T>(0.5);
  T const level = (a.value - b.value) * half;
  T const shift = (a.slope - b.slope + turn * (a.curvature_radius - b.curvature_radius)) * half;
  Point<2, T> const middle{half * branch[0] + level * normal[0] + shift * tangent[0],
                           half * branch[1] + level * normal[1] + shift * tangent[1]};
  // Deeper than half the radii of curvature the step may lead away from the least overlap.
  T const normal_error =
      lanes::select(curvature > depth, abs(turn), broadcast<T>(std::numeric_limits<double>::infinity()));
  return {overlap, turned, middle, {middle[0] - branch[0], middle[1] - branch[1]}, normal_error};
}

}  // namespace scarp

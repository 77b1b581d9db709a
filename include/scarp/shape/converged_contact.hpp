// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>

#include "scarp/shape/minimum_translation.hpp"

namespace scarp {

namespace detail {

/// Whether a search's step from this normal was the last one: it left a unit vector where it was, or turned it by so
/// small an angle that the square of it, which is left, is round-off. A shape without an estimate returns zero.
template <int Dim>
constexpr bool stands_still(ContactGeometry<Dim, double> const& touch, Point<Dim, double> const& before) {
  double change = 0.0;
  double excess = -1.0;
  for (std::size_t a = 0; a < before.size(); ++a) {
    change += (touch.normal[a] - before[a]) * (touch.normal[a] - before[a]);
    excess += before[a] * before[a];
  }
  double const length_error = std::abs(excess);
  return (change < 1e-28 && length_error < 1e-8) ||
         (touch.normal_error > 0.0 && touch.normal_error < 1e-8 && length_error < 1e-15);
}

/// Whether a normal at which the overlap is stationary is that of the least overlap. A gap is: a line parts the grains
/// there. An overlap less deep than a disc that rolls inside the sum of the shapes is too, since the disc touches the
/// boundary in no nearer point. Otherwise the other directions are looked at.
template <HasSupport Shape>
bool is_certainly_least(PoseOf<Shape> const& first, PoseOf<Shape> const& second, Point<2, double> const& branch,
                        ContactGeometry<2, double> const& touch) {
  if (touch.overlap <= 0.0) return true;
  if constexpr (HasInnerRadius<Shape>) {
    if (touch.overlap < Shape::inner_radius(first) + Shape::inner_radius(second)) return true;
  }
  return MinimumTranslation<Shape>(first, second, branch).is_least_along(touch.normal);
}

}  // namespace detail

/// Touch of a pair with the normal iterated until it stands still. Where it does not, or where another direction might
/// have less overlap, shapes with a support function use the slow but certain `minimum_translation`; of others a touch
/// that does not stand still has an infinite `normal_error`.
template <class Shape>
ContactGeometry<Shape::dim, double> converged_contact(PoseOf<Shape> const& first, PoseOf<Shape> const& second,
                                                      Point<Shape::dim, double> const& branch,
                                                      Point<Shape::dim, double> const& start) {
  auto touch = Shape::touch(first, second, branch, start);
  if constexpr (Shape::warm_starts_normal) {
    constexpr int max_iterations = 30;  // quadratic convergence: a handful is usual
    bool stands = detail::stands_still<Shape::dim>(touch, start);
    for (int k = 0; k < max_iterations && !stands; ++k) {
      auto const before = touch.normal;
      touch = Shape::touch(first, second, branch, before);
      stands = detail::stands_still<Shape::dim>(touch, before);
    }
    touch.normal_error = stands ? 0.0 : std::numeric_limits<double>::infinity();
    if constexpr (HasSupport<Shape>) {
      if (!stands || !detail::is_certainly_least<Shape>(first, second, branch, touch))
        return minimum_translation<Shape>(first, second, branch);
    }
  }
  return touch;
}

}  // namespace scarp

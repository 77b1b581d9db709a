// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <optional>

namespace scarp::detail {

/// Where unbalanced forces cease to do work along a straight way: of bodies with a potential the place of the least one. The
/// forces of stiffness and friction oppose motion ever more the farther it goes, so that there is one such place, also where
/// the size of the imbalance is flat and shows no way.
/// work(share): unbalanced (internal less external) forces times the way, at a share of it; negative at share 0, continuous
/// \param most largest share that is tried
/// \return share at which less than a thousandth of the work at 0 is left, nothing if there is none up to `most`
template <class Work>
std::optional<double> share_without_work(Work const& work, double most) {
  constexpr double left = 1e-3;
  constexpr int most_questions = 40;
  constexpr double least_bracket = 1e-10;  // of the share
  double const whole = work(0.0);
  if (!(whole < 0.0)) return std::nullopt;
  double below = 0.0;
  double above = 1.0;
  double before = whole;
  double after = work(above);
  while (after < 0.0) {
    if (-after <= -left * whole) return above;
    if (above >= most) return std::nullopt;
    below = above;
    before = after;
    above *= 2.0;
    after = work(above);
  }
  double share = above;
  double now = after;
  for (int k = 0; k < most_questions && std::abs(now) > -left * whole && above - below > least_bracket * above; ++k) {
    // The secant of the bracket, and now and then its middle, since the work bends sharply where points stick or open.
    share = k % 3 == 2 ? (below + above) / 2.0 : below + (above - below) * before / (before - after);
    now = work(share);
    (now < 0.0 ? below : above) = share;
    (now < 0.0 ? before : after) = now;
  }
  return share;
}

}  // namespace scarp::detail

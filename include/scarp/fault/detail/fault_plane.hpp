// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "scarp/core/error.hpp"

namespace scarp::detail {

/// Horizontal slip per throw on a plane that dips by so much [rad], 1/tan(dip); exactly zero for a vertical one.
/// \throws InputError for a dip outside (0, pi/2]
inline double heave_per_throw(double dip) {
  constexpr double vertical = std::numbers::pi / 2.0;
  if (!(dip > 0.0 && dip <= vertical * (1.0 + 4.0 * std::numeric_limits<double>::epsilon()))) {
    refuse("the dip is {} rad (a fault dips by more than 0 and at most pi/2): {}", dip,
           dip > vertical && dip <= 90.0 ? "was it given in degrees?" : "choose a dip in this range");
  }
  double const along = std::cos(dip);
  return std::abs(along) < std::numeric_limits<double>::epsilon() ? 0.0 : along / std::sin(dip);
}

}  // namespace scarp::detail

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/core/error.hpp"

namespace scarp {

/// What pore water at rest carries of level ground; none by default.
struct Buoyancy {
  double water_table = std::numeric_limits<double>::infinity();  ///< depth [m], negative above the ground surface
  double lift = 0.0;                                             ///< on the grains below it [N/m3], see Water::lift

  /// unit_weight [N/m3]: of the dry ground
  /// \throws InputError for a lift that is negative, not finite or more than the ground weighs, and a depth that is no
  /// number
  void validate(double unit_weight) const {
    require_not_negative("lift of ground below the water table", lift);
    if (lift > unit_weight)
      reject(
          "the unit weight is {} N/m3 (water lifts {} N/m3, so that the ground would float): give that of dry ground",
          unit_weight, lift);
    if (std::isnan(water_table)) reject("the depth of the water table is not a number: give it in metres");
  }
  /// Vertical pressure [Pa] that it takes from the ground at a depth [m].
  double relief(double depth) const { return lift * std::max(depth - std::max(water_table, 0.0), 0.0); }
};

}  // namespace scarp

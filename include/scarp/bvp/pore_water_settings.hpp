// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scarp/bvp/load_history.hpp"
#include "scarp/core/error.hpp"

namespace scarp {

/// Water at rest in the pores, which excess pressures count from.
struct WaterAtRest {
  double level = 0.0;           ///< height of the water table along the last axis [m], also above the ground
  double unit_weight = 9.81e3;  ///< [N/m3]
  double cavitation = -100e3;   ///< pressure over that of the air at which water turns to vapour [Pa]

  /// \throws InputError for a height that is not finite, a unit weight that is not positive and a positive pressure
  void validate() const {
    require_finite("height of the water table", level);
    require_positive("unit weight of the water at rest", unit_weight);
    require_not_negative("suction at which pore water cavitates (the pressure's opposite)", -cavitation);
  }
  /// Pressure over that of the air [Pa] at a height [m].
  double pressure(double height) const { return unit_weight * std::max(level - height, 0.0); }
};

/// What a `PoreWater` knows of ground and time.
struct PoreWaterSettings {
  /// About that of the ground [Pa]: it stabilises what an element cannot show, see PoreWater, and weighs the unknowns.
  double shear_modulus = 0.0;
  double void_ratio = 0.7;               ///< at the start, of regions without their own
  TimeFunction clock{};                  ///< time [s] over the load factor, not falling
  std::optional<double> begin{};         ///< time of the initial state [s]; without it the first one of the clock
  std::optional<WaterAtRest> at_rest{};  ///< without it all ground has water, of any pressure
  /// Largest error of one time step in the pressure of any corner [Pa], estimated as
  /// \f$ \frac{\Delta t}{2} |\dot u - \dot u_{before}| \f$: sizes the steps of `LoadStepping`. The largest counts and
  /// no mean, so that ground far from where water flows does not hide it. Without it steps follow load factor and
  /// clock.
  std::optional<double> largest_time_error{};

  /// \throws InputError for a modulus or an error that is not positive, times that fall or begin below `begin`, or
  /// below 0 without it, and wrong water at rest
  void validate() const {
    require_positive("shear modulus of the ground with pore water", shear_modulus);
    if (largest_time_error) require_positive("largest time error of the pore water", *largest_time_error);
    if (at_rest) at_rest->validate();
    double last = begin.value_or(0.0);
    double knot = clock.next_knot(-std::numeric_limits<double>::infinity());
    for (; std::isfinite(knot); knot = clock.next_knot(knot)) {
      if (!(clock(knot) >= last))
        reject(
            "the clock of the pore water shows {} s at the load factor {} after {} s (times begin at 0 s and do not "
            "fall): order them",
            clock(knot), knot, last);
      last = clock(knot);
    }
  }
  /// Time of the initial state [s].
  double beginning() const {
    double const first = clock.next_knot(-std::numeric_limits<double>::infinity());
    return begin.value_or(std::isfinite(first) ? clock(first) : 0.0);
  }
};

}  // namespace scarp

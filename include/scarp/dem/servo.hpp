// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>

#include "scarp/dem/drive.hpp"

namespace scarp {

/// Drives a packing until its held stresses are met and its forces balance.
struct Servo {
  StressFeedback feedback{};
  double stress_tolerance = 1e-4;  ///< relative to the largest target, to 0.001 of the springs' modulus for none
  double unbalanced_tolerance = 1e-4;
  long most_steps = 400'000;
  int check_every = 20;  ///< steps between tests of the stopping rule

  /// \return not_converged / unreachable or unbalanced after `most_steps`, or at once for a target no packing can carry
  template <class Stepper, class PackingType>
  Verdict reach(Stepper& stepper, PackingType& packing, typename PackingType::Law const& law,
                Loading<PackingType::dim> const& loading) const {
    if (!loading.reachable(Bonds<typename PackingType::Law>)) return {Status::not_converged, Reason::unreachable};
    constexpr double slight = 1e-3;  // of the springs, where no stress at all is asked
    double const asked = loading.stress_scale();
    double const tolerance = stress_tolerance * (asked > 0.0 ? asked : slight * spring_modulus(packing, law));
    Drive<PackingType> drive(packing, law, loading, feedback);
    for (long step = 1; step <= most_steps; ++step) {
      if (Verdict const verdict = drive.step(stepper); !verdict.acceptable()) return verdict;
      if (step % check_every != 0) continue;
      if (loading.worst_missing(drive.seen().stress) <= tolerance &&
          drive.seen().unbalanced_ratio <= unbalanced_tolerance)
        return {};
    }
    return {Status::not_converged,
            drive.seen().unbalanced_ratio > unbalanced_tolerance ? Reason::unbalanced : Reason::unreachable};
  }
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/described.hpp"

namespace scarp {

/// Beyond which numbers a run says that it is outside its error budget. All are relative; docs/error-budget.md gives the reasons.
struct ErrorBounds {
  double residual = 1e-2;         ///< largest of an accepted step, over the reactions
  double work_gap = 5e-2;         ///< external against internal work of the run
  double linear_residual = 1e-8;  ///< largest of a linear system
  double iterated_linear_residual =
      1e-2;                       ///< the same where it is iterated, and only as far as the next iteration needs
  double condition = 1e12;        ///< largest of a step's stiffness
  double unbalanced_mean = 2e-2;  ///< over all packings and steps
  double unbalanced_largest = 5e-2;
  double kinetic_share = 1e-2;    ///< largest, of a packing's pressure
  double inertial_number = 1e-2;  ///< largest of an answer
  double held_stress = 1e-2;      ///< of a single packing: missing from what a servo holds, root mean square
  double doubling_median = 5e-3;  ///< of the samples: stress with twice the work against the accepted one
  double doubling_95 = 5e-2;      ///< of nineteen samples in twenty
  double accumulated = 0.1;       ///< root of the mean square over the followed points, of their whole paths
  double mesh = 4e-2;             ///< against a companion on another mesh
  double load_step = 2e-2;        ///< against a companion with smaller load steps

  SCARP_MEMBERS(residual, work_gap, linear_residual, iterated_linear_residual, condition, unbalanced_mean,
                unbalanced_largest, kinetic_share, inertial_number, held_stress, doubling_median, doubling_95,
                accumulated, mesh, load_step)
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

namespace scarp {

/// Beyond which numbers a run says that it is outside its error budget. All are relative; docs/error-budget.md gives the reasons.
struct ErrorBounds {
  double residual = 1e-2;         ///< largest of an accepted step, over the reactions
  double work_gap = 5e-2;         ///< external against internal work of the run
  double linear_residual = 1e-8;  ///< largest of a linear system
  double condition = 1e12;        ///< largest of a step's stiffness
  double unbalanced_mean = 2e-2;  ///< over all packings and steps
  double unbalanced_largest = 5e-2;
  double kinetic_share = 1e-2;    ///< largest, of a packing's pressure
  double inertial_number = 1e-2;  ///< largest of an answer
  double held_stress = 1e-2;      ///< of a single packing: missing from what a servo holds, root mean square
  double doubling_median = 5e-3;  ///< of the samples: stress with twice the work against the accepted one
  double doubling_95 = 5e-2;      ///< of nineteen samples in twenty
  double accumulated = 2e-2;      ///< root of the mean square over the followed points, of their whole paths

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("residual", self.residual);
    visit("work_gap", self.work_gap);
    visit("linear_residual", self.linear_residual);
    visit("condition", self.condition);
    visit("unbalanced_mean", self.unbalanced_mean);
    visit("unbalanced_largest", self.unbalanced_largest);
    visit("kinetic_share", self.kinetic_share);
    visit("inertial_number", self.inertial_number);
    visit("held_stress", self.held_stress);
    visit("doubling_median", self.doubling_median);
    visit("doubling_95", self.doubling_95);
    visit("accumulated", self.accumulated);
  }
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"

namespace scarp {

/// One number of an error budget and the bound that was set for it.
struct BudgetPart {
  std::string name{};     ///< in the first column of budget_table()
  double value = 0.0;     ///< relative, see `meaning`
  double bound = 0.0;     ///< infinite: no bound
  std::string meaning{};  ///< in words, with what it is relative to

  /// NaN is outside.
  bool is_within() const { return value <= bound; }
};

/// Parts in the order of a report.
using BudgetParts = std::vector<BudgetPart>;

/// A line that names the parts outside their bounds; empty without any.
inline std::string budget_headline(BudgetParts const& parts) {
  std::string line;
  for (auto const& part : parts) {
    if (part.is_within()) continue;
    line += line.empty() ? "OUTSIDE ITS ERROR BUDGET: " : "; ";
    line += fmt::format("{} is {:.2g}, bound {:.2g}", part.name, part.value, part.bound);
  }
  return line.empty() ? line : line + '\n';
}

/// All parts as text, a line each.
inline std::string budget_table(BudgetParts const& parts) {
  std::string text = fmt::format("{:<24} {:>10} {:>10}   {}\n", "error budget", "value", "bound", "what it is");
  for (auto const& part : parts) {
    std::string const bound = std::isfinite(part.bound) ? fmt::format("{:.2e}", part.bound) : "none";
    text += fmt::format("{:<24} {:>10.2e} {:>10} {} {}\n", part.name, part.value, bound, part.is_within() ? ' ' : '!',
                        part.meaning);
  }
  return text;
}

/// Part of an error budget that a single run cannot estimate: how far its result is from that of a sensitivity run, the
/// same scene with one choice made otherwise - a mesh of other directions, smaller load steps.
struct Sensitivity {
  double own = 0.0;    ///< measure of the run
  double other = 0.0;  ///< the same of the sensitivity run
  double size = 0.0;   ///< what an error is relative to, in the measure's unit
  double bound = 0.0;  ///< of the difference over the size

  /// \throws InputError for a size that is not finite and positive, and for a bound that is negative or NaN
  BudgetPart part(std::string name, std::string meaning) const {
    require_positive("size that a sensitivity run's difference is relative to", size);
    require_at_least("bound of a sensitivity run's difference", bound, 0.0);
    return {std::move(name), std::abs(other - own) / size, bound, std::move(meaning)};
  }
};

/// Bounds beyond which a run reports that it is outside its error budget. All are relative; docs/error-budget.md gives
/// the reasons.
struct ErrorBounds {
  double residual = 1e-2;         ///< largest of an accepted step, over the forces that act
  double work_gap = 5e-2;         ///< external against internal work of the run
  double linear_residual = 1e-8;  ///< largest of a linear system
  double iterated_linear_residual =
      1e-2;                          ///< the same where it is iterated, and only as far as the next iteration needs
  double condition = 1e12;           ///< largest of a step's stiffness
  double unbalanced_mean = 2e-2;     ///< over all packings and steps
  double unbalanced_largest = 5e-2;  ///< over all packings and steps
  double kinetic_share = 1e-2;       ///< largest, of a packing's pressure
  double inertial_number = 1e-2;     ///< largest of a response
  double held_stress = 1e-2;         ///< of a single packing: missing from what a servo holds, root mean square
  double doubling_median =
      1e-2;  ///< of samples spread over all points: stress with twice the work against the accepted one
  double doubling_95 = 5e-2;       ///< difference that 19/20 of the samples' stress does not exceed
  double doubling_strained = 0.1;  ///< difference that 19/20 of the most strained points' stress does not exceed
  double accumulated = 0.05;       ///< of the tracked points together, on their whole paths
  double mesh = 4e-2;              ///< against a sensitivity run on another mesh
  double load_step = 2e-2;         ///< against a sensitivity run with smaller load steps
  double volume = 1e-2;            ///< that the ground has gained and its packings have not, as a displacement
  double water = 1e-2;             ///< largest residual of a field of an accepted step, such as pore water's volumes
  double time = 0.3;               ///< largest estimated error of a field in one time step, over its largest value

  /// Infinite: no bound. \throws InputError for a bound that is negative or NaN
  void validate() const {
    members(*this, [](std::string_view name, double bound) {
      require_at_least(fmt::format("bound of the error budget's {}", name), bound, 0.0);
    });
  }

  SCARP_MEMBERS(residual, work_gap, linear_residual, iterated_linear_residual, condition, unbalanced_mean,
                unbalanced_largest, kinetic_share, inertial_number, held_stress, doubling_median, doubling_95,
                doubling_strained, accumulated, mesh, load_step, volume, water, time)
};

/// Points and shares that an error budget samples.
struct ErrorSampling {
  double share = 0.04;          ///< of the run's work that all checks may cost; tracked points come first
  int max_samples = 2;          ///< of one step
  int points_per_tracked = 40;  ///< one of so many points is tracked through the run,
  int max_tracked = 24;         ///< at most so many,
  std::vector<int> tracked{};   ///< and these
  double pressure_floor =
      0.0;  ///< [Pa]; stresses that were below this pressure from the beginning count as large as it

  /// \throws InputError for numbers that are negative or not finite
  void validate() const {
    require_not_negative("share of work for samples", share);
    require_not_negative("pressure floor", pressure_floor);
    require_at_least("number of samples of a step", max_samples, 0);
    require_at_least("number of tracked points", max_tracked, 0);
    require_at_least("number of points for a tracked one", points_per_tracked, 1);
  }
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "scarp/core/error.hpp"
#include "scarp/solver/step_report.hpp"
#include "stability/stability_case.hpp"

namespace stability {

/// The largest magnitude that was seen; what is not finite counts as infinite.
struct Worst {
  double value = 0.0;

  void see(double seen) {
    value = std::max(value, std::isfinite(seen) ? std::abs(seen) : std::numeric_limits<double>::infinity());
  }
};

/// Keeps the worst of the linear systems, and stops what would not end.
struct Watch {
  int most = 3000;  ///< attempts
  int attempts = 0;
  double linear_residual = 0.0;
  double condition = 0.0;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const& report) {
    ++attempts;
    for (auto const& record : report.history) linear_residual = std::max(linear_residual, record.linear_residual);
    condition = std::max(condition, report.condition);
  }
  bool wants_stop() const { return attempts >= most; }
};

/// As expected if the measure is finite and not above a limit.
inline Outcome at_most(double limit, double worst, std::string measure, std::string remark = {}) {
  return {std::isfinite(worst) && worst <= limit, worst, std::move(measure), std::move(remark)};
}

/// Whether an action is refused as wrong input, in words that name the problem.
template <class Action>
bool refuses(Action&& action, std::string_view words) {
  try {
    action();
  } catch (scarp::InputError const& error) {
    return std::string_view(error.what()).find(words) != std::string_view::npos;
  }
  return false;
}

inline double relative(double value, double reference) { return std::abs(value / reference - 1.0); }

}  // namespace stability

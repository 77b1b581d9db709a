// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "scarp/solver/step_report.hpp"

/// Stiff and extreme cases: each states its expected response or status and judges itself.
namespace stability {

/// How much work a case may take: seconds, or as much as its numbers deserve.
enum class Size { quick, full };

struct Outcome {
  bool as_expected = false;
  double worst = 0.0;     ///< value of the measure; one that is not finite fails the case
  std::string measure{};  ///< meaning of `worst`, such as "largest drift of the stress ratio"
  std::string remark{};
};

struct Case {
  std::string group{};
  std::string name{};
  std::string expected{};  ///< response or status, in words
  std::function<Outcome(Size)> run{};
};

using Cases = std::vector<Case>;

// One source for each: <name>.cpp.
Cases grain_cases();
Cases rve_cases();
Cases strength_cases();
Cases mesh_cases();
Cases solver_cases();
Cases fault_cases();
Cases footing_cases();

/// The largest magnitude that was seen; what is not finite counts as infinite.
struct Worst {
  double value = 0.0;

  void see(double seen) {
    value = std::max(value, std::isfinite(seen) ? std::abs(seen) : std::numeric_limits<double>::infinity());
  }
};

/// Keeps the worst of the linear systems, and stops a run that would not end.
struct Watch {
  int most = 3000;  ///< attempts
  int attempts = 0;
  double linear_residual = 0.0;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const& report) {
    ++attempts;
    for (auto const& record : report.history) linear_residual = std::max(linear_residual, record.linear_residual);
  }
  bool wants_stop() const { return attempts >= most; }
};

/// As expected if the measure is finite and not above a limit.
inline Outcome at_most(double limit, double worst, std::string measure, std::string remark = {}) {
  return {std::isfinite(worst) && worst <= limit, worst, std::move(measure), std::move(remark)};
}

inline double relative(double value, double reference) { return std::abs(value / reference - 1.0); }

}  // namespace stability

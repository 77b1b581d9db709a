// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <utility>

#include "scarp/bvp/grid.hpp"
#include "scarp/observe/observers.hpp"

namespace scarp {

/// A line for every attempt on the error stream: step, load, residual, iterations, elapsed and remaining time.
class Progress : public NeverStops {
 public:
  /// name: before every line, of one run among several
  Progress(double to, LoadMeasure measure, std::string name = {})
      : to_(require_finite("end of the load", to)),
        measure_(detail::validated(std::move(measure))),
        name_(std::move(name)),
        started_(std::chrono::steady_clock::now()) {}

  /// Writes a line for an attempt, with the reason of a rejected one.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    if (from_ < 0.0 && report.load > 0.0) from_ = report.load - report.load_increment;
    double const elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    if (report.verdict.acceptable()) {
      double const left = std::max(to_ - report.load, 0.0);
      double const done = report.load - from_;  // none where the ground settles at a load
      double const remaining = report.load > 0.0 && done > 0.0 ? elapsed * left / done : 0.0;
      print("{}step {:4}  {} {:.5f}  residual {:.2e}  iterations {:2}  elapsed {:6.1f} s  remaining {:6.1f} s\n", name_,
            report.step, measure_.name, measure_.of(report.load), report.residual(), report.iterations(), elapsed,
            remaining);
    } else {
      print("{}step {:4}  rejected at {} {:.5f} after {} iterations, residual {:.2e}: {}{}; rolled back\n", name_,
            report.step, measure_.name, measure_.of(report.load), report.iterations(), report.residual(),
            name(report.verdict.reason), where(problem, report));
    }
  }

  SCARP_MEMBERS_EXCEPT((to_, measure_, name_, from_, started_))  // the time that remains is guessed anew

 private:
  /// An error stream that cannot be written ends no run.
  template <class... Arguments>
  static void print(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    std::fputs(fmt::format(text, std::forward<Arguments>(arguments)...).c_str(), stderr);
    std::fflush(stderr);
  }

  template <class Problem>
  static std::string where(Problem const& problem, StepReport const& report) {
    if (report.weak_dof >= 0) return fmt::format(", nothing holds {}", problem.describe_dof(report.weak_dof));
    if (report.worst_point < 0) return "";
    auto const place = problem.grid().site(report.worst_point, 0.0).position;
    return fmt::format(" at point {} ({})", report.worst_point, listed(place, ", ", "{:.2f}"));
  }

  double to_;
  LoadMeasure measure_;
  std::string name_;
  double from_ = -1.0;  ///< load of the fault's motion at the first attempt, zero unless the run continues another
  std::chrono::steady_clock::time_point started_;
};

}  // namespace scarp

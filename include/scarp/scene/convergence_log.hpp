// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>

#include "scarp/io/csv.hpp"
#include "scarp/scene/observers.hpp"

namespace scarp {

/// One row for every iteration of every attempt, refused ones included.
class ConvergenceLog : public NeverStops {
 public:
  ConvergenceLog(std::filesystem::path const& file, double load_unit, CsvStart start = CsvStart::anew)
      : log_(file,
             {"step", "throw_over_depth", "iteration", "residual", "accepted", "reason", "largest_gradient",
              "dem_steps", "seconds"},
             start),
        load_unit_(load_unit) {}

  template <class Problem>
  void attempted(Problem const&, StepReport const& report) {
    int iteration = 0;
    for (auto const& record : report.history) {
      ++iteration;
      bool const accepted = report.verdict.acceptable() && iteration == report.iterations();
      log_.add(report.step, report.load / load_unit_, iteration, record.residual, accepted ? 1 : 0,
               name(report.verdict.reason), report.largest_gradient, record.inner_steps, record.material_seconds);
    }
  }

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("log", self.log_);
  }

 private:
  CsvLog log_;
  double load_unit_;
};

}  // namespace scarp

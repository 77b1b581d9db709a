// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/measure/cpu_time.hpp"
#include "scarp/solver/step_report.hpp"

namespace error_vs_time {

/// Ends a run between two attempts once its CPU time [s] is spent: a run that is too slow is a row with a reason, not a day.
class CpuTimeLimit {
 public:
  explicit CpuTimeLimit(double most) : most_(most) {}

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const&) {}
  bool wants_stop() const { return time_.seconds() > most_; }

 private:
  double most_;
  scarp::CpuTime time_;
};

}  // namespace error_vs_time

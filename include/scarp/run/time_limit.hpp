// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

/// Ends a run once its wall time is spent. [s]; zero means no limit.
class TimeLimit {
 public:
  using Moment = std::chrono::steady_clock::time_point;  ///< monotonic, so that changes of the clock have no effect

  /// started: when the time began to count, for instance before the scene was prepared
  /// \throws InputError for a limit that is negative or NaN
  explicit TimeLimit(double seconds, Moment started = std::chrono::steady_clock::now())
      : seconds_(require_at_least("time limit", seconds, 0.0)), started_(started) {}

  template <class Problem>
  void attempted(Problem const&, StepReport const&) {}  ///< Records nothing.

  /// Whether the wall time is spent; without a limit never.
  bool wants_stop() const {
    return seconds_ > 0.0 &&
           std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count() > seconds_;
  }

  SCARP_MEMBERS_EXCEPT((seconds_, started_))  // a resumed run has all its time again

 private:
  double seconds_;
  Moment started_;
};

}  // namespace scarp

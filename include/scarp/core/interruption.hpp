// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <utility>

#include "scarp/core/one_version.hpp"

namespace scarp {

/// As long as it lives, long work on this thread, and on a team of threads that this one calls, runs a check between
/// grains, DEM steps, points and factorisations. What the check throws ends the work and leaves committed states as
/// they are. Threads run it at the same time.
class InterruptionCheck {
 public:
  /// check: outlives this object
  explicit InterruptionCheck(std::function<void()> const* check) : before_(std::exchange(now_, check)) {}
  InterruptionCheck(InterruptionCheck const&) = delete;
  InterruptionCheck& operator=(InterruptionCheck const&) = delete;
  ~InterruptionCheck() { now_ = before_; }

  /// The check of this thread, null without one.
  static std::function<void()> const* now() { return now_; }
  /// Runs the check of this thread, where there is one.
  static void run() {
    if (now_) (*now_)();
  }

 private:
  static inline thread_local std::function<void()> const* now_ = nullptr;
  std::function<void()> const* before_;
};

}  // namespace scarp

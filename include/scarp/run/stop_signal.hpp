// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>
#include <csignal>

#include "scarp/solver/step_report.hpp"

namespace scarp {

namespace detail {
inline std::atomic<bool> stop_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch a lock-free flag");
}  // namespace detail

/// Ends a run when the process gets SIGINT (Ctrl-C) or SIGTERM; a second signal ends it at once.
struct StopSignal {
  StopSignal() {
    for (int const signal : {SIGINT, SIGTERM}) {
      std::signal(signal, [](int number) {
        detail::stop_asked = true;
        std::signal(number, SIG_DFL);
      });
    }
  }

  template <class Problem>
  void attempted(Problem const&, StepReport const&) {}
  static bool wants_stop() { return detail::stop_asked; }
};

}  // namespace scarp

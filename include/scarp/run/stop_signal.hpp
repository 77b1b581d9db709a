// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>
#include <csignal>

#include "scarp/solver/step_report.hpp"

namespace scarp {

namespace detail {
inline std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch a lock-free flag");
}  // namespace detail

/// Ends a run when the process gets SIGINT (Ctrl-C), SIGTERM, SIGHUP (the terminal is gone, unless started by nohup) or SIGPIPE
/// (nobody reads its output any more); a second signal ends it at once, but for SIGPIPE.
struct StopSignal {
  StopSignal() {
    auto const stop = [](int number) {
      detail::stop_requested = true;
      std::signal(number, SIG_DFL);
    };
    for (int const signal : {SIGINT, SIGTERM}) std::signal(signal, stop);
#ifdef SIGHUP
    if (std::signal(SIGHUP, stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    std::signal(SIGPIPE, [](int number) {
      detail::stop_requested = true;
      std::signal(number, SIG_IGN);
    });
#endif
  }

  template <class Problem>
  void attempted(Problem const&, StepReport const&) {}         ///< Records nothing.
  static bool wants_stop() { return detail::stop_requested; }  ///< Whether the process has received a signal.
};

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <mutex>

#include "scarp/core/described.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

namespace detail {

inline std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch a lock-free flag");

/// Handlers of signals as long as an object of this class lives, then those that were there before.
class StopHandlers {
 public:
  StopHandlers() {
    std::lock_guard const lock(mutex);
    if (alive++ == 0) install();
  }
  StopHandlers(StopHandlers const&) : StopHandlers() {}
  StopHandlers& operator=(StopHandlers const&) = default;
  ~StopHandlers() {
    std::lock_guard const lock(mutex);
    if (--alive == 0) restore();
  }

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGUSR1, SIGUSR2, SIGXCPU};

  static void install() {
    stop_requested = false;
    struct sigaction action {};
    action.sa_handler = [](int number) {
      stop_requested = true;
      std::signal(number, number == SIGPIPE ? SIG_IGN : SIG_DFL);
    };
    action.sa_flags = SA_RESTART;  // else a table that is being written loses a part
    for (std::size_t k = 0; k < signals.size(); ++k) {
      ::sigaction(signals[k], nullptr, &before[k]);
      bool const is_left = signals[k] == SIGHUP && before[k].sa_handler == SIG_IGN;
      if (!is_left) ::sigaction(signals[k], &action, nullptr);
    }
  }

  static void restore() {
    for (std::size_t k = 0; k < signals.size(); ++k) ::sigaction(signals[k], &before[k], nullptr);
    stop_requested = false;
  }

  inline static std::mutex mutex;
  inline static int alive = 0;  ///< objects, of all threads
  inline static std::array<struct sigaction, signals.size()> before{};
};

}  // namespace detail

/// Ends a run when the process gets SIGINT (Ctrl-C), SIGTERM, SIGHUP (the terminal is gone, unless started by nohup),
/// SIGPIPE (nobody reads its output any more), or SIGUSR1, SIGUSR2 and SIGXCPU (a batch system is about to end it). A
/// second signal of the same kind ends it at once, but for SIGPIPE; one of another kind does not, since batch systems
/// send several. Reads and writes that a signal interrupts continue. When the last of these objects is gone, the
/// handlers are those from before it, and the signal is forgotten.
class StopSignal {
 public:
  template <class Problem>
  void attempted(Problem const&, StepReport const&) {}         ///< Records nothing.
  static bool wants_stop() { return detail::stop_requested; }  ///< Whether the process has received a signal.

  SCARP_MEMBERS_EXCEPT((handlers_))  // a resumed run gets signals of its own

 private:
  detail::StopHandlers handlers_;
};

}  // namespace scarp

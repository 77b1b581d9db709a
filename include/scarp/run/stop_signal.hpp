// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <memory>
#include <mutex>

#include "scarp/core/described.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

namespace detail {

inline std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch a lock-free flag");

/// Handlers of signals as long as it lives, then those that were there before.
class StopHandlers {
 public:
  /// Of all objects that live at the same time.
  static std::shared_ptr<StopHandlers const> shared() {
    static std::mutex mutex;
    static std::weak_ptr<StopHandlers const> present;
    std::lock_guard const lock(mutex);
    auto handlers = present.lock();
    if (!handlers) present = handlers = std::make_shared<StopHandlers const>();
    return handlers;
  }

  StopHandlers() {
    stop_requested = false;
    struct sigaction action {};
    action.sa_handler = [](int number) {
      stop_requested = true;
      std::signal(number, number == SIGPIPE ? SIG_IGN : SIG_DFL);
    };
    for (std::size_t k = 0; k < signals.size(); ++k) {
      ::sigaction(signals[k], nullptr, &before_[k]);
      bool const is_left = signals[k] == SIGHUP && before_[k].sa_handler == SIG_IGN;
      if (!is_left) ::sigaction(signals[k], &action, nullptr);
    }
  }
  StopHandlers(StopHandlers const&) = delete;
  StopHandlers& operator=(StopHandlers const&) = delete;
  ~StopHandlers() {
    for (std::size_t k = 0; k < signals.size(); ++k) ::sigaction(signals[k], &before_[k], nullptr);
    stop_requested = false;
  }

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGUSR1, SIGUSR2, SIGXCPU};

  std::array<struct sigaction, signals.size()> before_{};
};

}  // namespace detail

/// Ends a run when the process gets SIGINT (Ctrl-C), SIGTERM, SIGHUP (the terminal is gone, unless started by nohup),
/// SIGPIPE (nobody reads its output any more), or SIGUSR1, SIGUSR2 and SIGXCPU (a batch system is about to end it); a
/// second signal ends it at once, but for SIGPIPE. When the last of these objects is gone, the handlers are those from
/// before it, and the signal is forgotten.
class StopSignal {
 public:
  template <class Problem>
  void attempted(Problem const&, StepReport const&) {}         ///< Records nothing.
  static bool wants_stop() { return detail::stop_requested; }  ///< Whether the process has received a signal.

  SCARP_MEMBERS_EXCEPT((handlers_))  // a resumed run gets signals of its own

 private:
  std::shared_ptr<detail::StopHandlers const> handlers_ = detail::StopHandlers::shared();
};

}  // namespace scarp

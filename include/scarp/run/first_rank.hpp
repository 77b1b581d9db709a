// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <string>

#include "scarp/io/state_bits.hpp"
#include "scarp/run/visit_point.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

/// Copy of a point's state, from the process that has it. local: the point's number in its field
template <SharesPoints Executor, class Field>
typename Field::State state_elsewhere(Executor const& executor, Field const& field, int point, int local) {
  auto state = field.blank_state(local);
  std::string const bytes = executor.ask(point);
  StateReader reader(bytes);
  reader("state", state);
  return state;
}

/// Whether this process is the first, or the only one.
template <ExecutesTasks Executor>
bool is_first_rank(Executor const& executor) {
  if constexpr (SharesPoints<Executor>) {
    return executor.rank() == 0;
  } else {
    static_cast<void>(executor);
    return true;
  }
}

/// What the first rank says.
template <ExecutesTasks Executor>
bool agreed(Executor const& executor, bool said) {
  if constexpr (SharesPoints<Executor>) {
    return executor.agree(said);
  } else {
    static_cast<void>(executor);
    return said;
  }
}

/// Runs a task on the first rank only, which may look at the points of all ranks by visit_point; the others answer meanwhile.
/// What one of them throws ends all.
template <class Problem, class Task>
void on_first_rank(Problem const& problem, Task const& task) {
  auto const& executor = problem.executor();
  using Executor = std::remove_cvref_t<decltype(executor)>;
  if constexpr (SharesPoints<Executor>) {
    executor.on_first(task, [&](int point) {
      StateWriter writer;
      visit_point(problem, point, [&](auto const&, auto const& state) { writer("state", state); });
      return writer.bits();
    });
  } else {
    task();
  }
}

/// Observers that live on the first rank; all ranks stop when they want to.
template <class Executor, class Observers>
class OnFirstRank {
 public:
  /// make(): the observers, called on the first rank only
  template <std::invocable Make>
  OnFirstRank(Executor const& executor, Make const& make) : executor_(executor) {
    together(executor, [&] {
      if (is_first_rank(executor)) observers_.emplace(make());
    });
  }

  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    on_first_rank(problem, [&] { observers_->attempted(problem, report); });
  }

  template <class Problem>
  void ended(Problem const& problem, double load) {
    on_first_rank(problem, [&] { observers_->ended(problem, load); });
  }

  bool wants_stop() const {
    bool said = false;
    together(executor_, [&] { said = observers_ && observers_->wants_stop(); });
    return agreed(executor_, said);
  }

  /// Of the observers; nothing on other ranks.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) requires Described<Observers> {
    if (self.observers_) Observers::members(*self.observers_, visit);
  }

 private:
  Executor const& executor_;
  std::optional<Observers> observers_;
};

template <class Executor, class Make>
OnFirstRank(Executor const&, Make const&) -> OnFirstRank<Executor, std::invoke_result_t<Make>>;

}  // namespace scarp

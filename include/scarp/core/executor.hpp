// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <vector>

namespace scarp {

/// for_each(count, task): calls task(i) once for every i in [0, count), in any order, perhaps at the same time.
template <class Executor>
concept ExecutesTasks = requires(Executor& executor, void (&task)(int)) {
  executor.for_each(0, task);
};

/// One of several processes that run the same program, each of which owns some of the material points.
/// owns(point): whether this process owns a point; share(values): completes an array over all points of which
/// every process has the entries of its own; together(work): does it, and throws everywhere what it throws on one process. All
/// processes must call share and together alike.
template <class Executor>
concept SharesPoints = ExecutesTasks<Executor> && requires(Executor& executor, std::vector<double>& values) {
  { executor.owns(0) } -> std::same_as<bool>;
  executor.share(values);
  executor.together([] {});
};

/// One task after the other on the calling thread.
struct SerialExecutor {
  /// Calls task(i) for i from 0 to count - 1, in this order.
  template <std::invocable<int> Task>
  void for_each(int count, Task&& task) const {
    for (int i = 0; i < count; ++i) task(i);
  }
};

static_assert(ExecutesTasks<SerialExecutor> && !SharesPoints<SerialExecutor>);

/// Whether this process owns a point; always, unless the executor shares points out.
template <ExecutesTasks Executor>
bool owns_point(Executor const& executor, int point) {
  if constexpr (SharesPoints<Executor>) {
    return executor.owns(point);
  } else {
    static_cast<void>(executor), static_cast<void>(point);
    return true;
  }
}

/// Work that all processes begin alike: what it throws on one of them is thrown on all.
template <ExecutesTasks Executor, class Work>
void together(Executor const& executor, Work const& work) {
  if constexpr (SharesPoints<Executor>) {
    executor.together(work);
  } else {
    static_cast<void>(executor);
    work();
  }
}

}  // namespace scarp

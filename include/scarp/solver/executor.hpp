// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>

namespace scarp {

/// for_each(count, task): calls task(i) once for every i in [0, count), in any order, perhaps at the same time.
template <class Executor>
concept ExecutesTasks = requires(Executor& executor, void (&task)(int)) {
  executor.for_each(0, task);
};

/// One task after the other on the calling thread.
struct SerialExecutor {
  template <std::invocable<int> Task>
  void for_each(int count, Task&& task) const {
    for (int i = 0; i < count; ++i) task(i);
  }
};

static_assert(ExecutesTasks<SerialExecutor>);

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/solver/executor.hpp"

namespace scarp {

/// A fixed team of threads that take the next task when they have finished one, so that tasks of very different length
/// share out evenly. Tasks write only their own results: the answer has the same bits for any number of threads.
class ThreadExecutor {
 public:
  /// threads, the calling one included; 0 takes as many as the machine has \throws InputError for a negative number
  explicit ThreadExecutor(int threads = 0) {
    if (threads < 0)
      refuse("{} threads were asked for (at least one must work): give a positive number, or 0 for all", threads);
    if (threads == 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    for (int k = 1; k < threads; ++k) team_.emplace_back([this] { serve(); });
  }

  ThreadExecutor(ThreadExecutor const&) = delete;
  ThreadExecutor& operator=(ThreadExecutor const&) = delete;

  ~ThreadExecutor() {
    {
      std::lock_guard const lock(mutex_);
      over_ = true;
    }
    begin_.notify_all();
  }

  int threads() const { return detail::count(team_) + 1; }

  /// An exception of a task is rethrown here after all threads have come to rest. Within a task the tasks run one after
  /// the other on its own thread, since the team is at work; calls of several threads wait for one another.
  template <std::invocable<int> Task>
  void for_each(int count, Task&& task) {
    if (at_work_for_ == this) {
      for (int i = 0; i < count; ++i) task(i);
      return;
    }
    std::lock_guard const one_round(rounds_);
    {
      std::lock_guard const lock(mutex_);
      task_ = std::ref(task);
      count_ = count;
      next_ = 0;
      busy_ = detail::count(team_);
      ++round_;
    }
    begin_.notify_all();
    work();
    std::unique_lock lock(mutex_);
    end_.wait(lock, [this] { return busy_ == 0; });
    task_ = nullptr;
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

 private:
  void work() {
    ThreadExecutor const* const before = std::exchange(at_work_for_, this);
    for (int i = next_++; i < count_; i = next_++) {
      try {
        task_(i);
      } catch (...) {
        std::lock_guard const lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        next_ = count_;
      }
    }
    at_work_for_ = before;
  }

  void serve() {
    for (long seen = 0;;) {
      {
        std::unique_lock lock(mutex_);
        begin_.wait(lock, [&] { return over_ || round_ != seen; });
        if (over_) return;
        seen = round_;
      }
      work();
      std::lock_guard const lock(mutex_);
      if (--busy_ == 0) end_.notify_one();
    }
  }

  static inline thread_local ThreadExecutor const* at_work_for_ = nullptr;  ///< of whose round this thread runs a task

  std::mutex rounds_;
  std::mutex mutex_;
  std::condition_variable begin_;
  std::condition_variable end_;
  std::function<void(int)> task_;
  int count_ = 0;
  std::atomic<int> next_ = 0;
  int busy_ = 0;
  long round_ = 0;
  bool over_ = false;
  std::exception_ptr failure_;
  std::vector<std::jthread> team_;
};

static_assert(ExecutesTasks<ThreadExecutor>);

}  // namespace scarp

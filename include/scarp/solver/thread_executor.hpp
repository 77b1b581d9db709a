// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>
#include <functional>

#include "scarp/core/executor.hpp"
#include "scarp/core/precompiled.hpp"
#ifdef SCARP_DEFINITIONS
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/interruption.hpp"
#include "scarp/core/process.hpp"
#endif

namespace scarp {

/// A fixed team of threads that take the next task when they have finished one, so that tasks of very different length
/// share out evenly. Tasks write only their own results: the result has the same bits for any number of threads.
/// In a process that was forked none of the threads exists: there the first call makes another team.
class SCARP_EXPORT ThreadExecutor : public Executor {
 public:
  /// threads, the calling one included; 0: as many as the process may use
  /// \throws InputError for a negative number, or more than can be started
  explicit ThreadExecutor(int threads = 0);

  ThreadExecutor(ThreadExecutor const&) = delete;
  ThreadExecutor& operator=(ThreadExecutor const&) = delete;
  ~ThreadExecutor() override;

  int threads() const override;  ///< The calling thread included.

  /// An exception of a task is rethrown here after all threads have come to rest. A task that calls a team which is at
  /// work, its own or another one, does its tasks one after the other on its own thread; otherwise calls of several
  /// threads wait for one another.
  void for_each(int count, std::function<void(int)> const& task) const override;

 private:
  class Team;

  /// The team of this process. One of the process that this was forked from is forgotten: its threads cannot be joined,
  /// and its mutex may be locked for ever.
  Team& team() const;

  mutable std::atomic<Team*> team_;
};

#ifdef SCARP_DEFINITIONS
/// Threads that serve one round of tasks after another.
class ThreadExecutor::Team {
 public:
  explicit Team(int threads) {
    if (threads < 0)
      reject("{} threads were requested (at least one must work): give a positive number, or 0 for all", threads);
    if (threads == 0) threads = usable_processors();
    try {
      others_.reserve(static_cast<std::size_t>(threads - 1));
      for (int k = 1; k < threads; ++k) others_.emplace_back([this] { serve(); });
    } catch (std::exception const& error) {  // of the system or of memory
      int const started = size();
      end_service();
      reject(
          "{} threads were requested (only {} could be started: {}): request fewer, or raise the limit of processes "
          "and memory",
          threads, started, error.what());
    }
  }
  ~Team() { end_service(); }

  int size() const { return detail::count(others_) + 1; }
  bool is_here() const { return process_ == detail::process_number(); }

  /// \return false for a task of this or another team while this one is at work: waiting might never end
  bool begin_round(int count, std::function<void(int)> const& task) {
    std::unique_lock lock(mutex_);
    if (in_round_ && within_task_) return false;
    free_.wait(lock, [this] { return !in_round_; });
    in_round_ = true;
    task_ = &task;
    check_ = InterruptionCheck::now();
    count_ = count;
    next_ = 0;
    busy_ = detail::count(others_);
    ++round_;
    lock.unlock();
    begin_.notify_all();
    return true;
  }

  void work() {
    bool const before = std::exchange(within_task_, true);
    InterruptionCheck const checked(check_);
    for (int i = next_++; i < count_; i = next_++) {
      try {
        (*task_)(i);
      } catch (...) {
        std::lock_guard const lock(mutex_);
        fail();
      }
    }
    within_task_ = before;
  }

  /// \return what a task has thrown
  std::exception_ptr end_round() {
    std::unique_lock lock(mutex_);
    constexpr std::chrono::milliseconds between_checks(100);
    while (!end_.wait_for(lock, between_checks, [this] { return busy_ == 0; })) {
      lock.unlock();
      try {
        InterruptionCheck::run();
        lock.lock();
      } catch (...) {
        lock.lock();
        fail();
      }
    }
    task_ = nullptr;
    std::exception_ptr failure = std::exchange(failure_, nullptr);
    in_round_ = false;
    lock.unlock();
    free_.notify_one();
    return failure;
  }

 private:
  /// Keeps the exception that is handled now, for the caller, and leaves further tasks out.
  void fail() {
    if (!failure_) failure_ = std::current_exception();
    next_ = count_;
  }

  void end_service() {
    {
      std::lock_guard const lock(mutex_);
      over_ = true;
    }
    begin_.notify_all();
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

  static inline thread_local bool within_task_ = false;  ///< this thread runs a task of some team

  long process_ = detail::process_number();
  std::mutex mutex_;
  std::condition_variable free_;
  std::condition_variable begin_;
  std::condition_variable end_;
  std::function<void(int)> const* task_ = nullptr;  ///< of the caller
  std::function<void()> const* check_ = nullptr;    ///< of the caller
  int count_ = 0;
  std::atomic<int> next_ = 0;
  int busy_ = 0;
  long round_ = 0;
  bool in_round_ = false;
  bool over_ = false;
  std::exception_ptr failure_;
  std::vector<std::jthread> others_;
};
SCARP_DEFINITIONS ThreadExecutor::ThreadExecutor(int threads) : team_(new Team(threads)) {}

SCARP_DEFINITIONS ThreadExecutor::~ThreadExecutor() {
  if (team_.load()->is_here()) delete team_.load();
}

SCARP_DEFINITIONS int ThreadExecutor::threads() const { return team_.load()->size(); }

SCARP_DEFINITIONS void ThreadExecutor::for_each(int count, std::function<void(int)> const& task) const {
  Team& team = this->team();
  if (!team.begin_round(count, task)) {
    for (int i = 0; i < count; ++i) task(i);
    return;
  }
  team.work();
  if (std::exception_ptr const failure = team.end_round()) std::rethrow_exception(failure);
}

SCARP_DEFINITIONS ThreadExecutor::Team& ThreadExecutor::team() const {
  Team* own = team_;
  if (!own->is_here()) {
    auto made = std::make_unique<Team>(own->size());
    if (team_.compare_exchange_strong(own, made.get())) own = made.release();
  }
  return *own;
}
#endif

}  // namespace scarp

// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "scarp/core/interruption.hpp"
#include "scarp/core/process.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace {

/// How often each index in [0, count) was called.
std::vector<int> calls(scarp::Executor const& executor, int count) {
  std::vector<int> times(static_cast<std::size_t>(count), 0);
  executor.for_each(count, [&](int i) { ++times[static_cast<std::size_t>(i)]; });
  return times;
}

}  // namespace

TEST_CASE("the serial executor calls every task once and in order") {
  scarp::SerialExecutor const serial;
  std::vector<int> order;
  serial.for_each(5, [&](int i) { order.push_back(i); });
  CHECK(order == std::vector<int>{0, 1, 2, 3, 4});
  CHECK_THROWS_AS(serial.for_each(3, [](int i) { throw std::out_of_range(std::to_string(i)); }), std::out_of_range);
}

TEST_CASE("one to seven threads call every task once, round after round") {
  for (int threads = 1; threads <= 7; ++threads) {
    scarp::ThreadExecutor executor(threads);
    REQUIRE(executor.threads() == threads);
    for (int round = 0; round < 200; ++round) {
      int const count = round % 13;  // also none, and fewer than threads
      CHECK(calls(executor, count) == std::vector<int>(static_cast<std::size_t>(count), 1));
    }
    CHECK(calls(executor, 5000) == std::vector<int>(5000, 1));
  }
}

TEST_CASE("several threads share the tasks out") {
  scarp::ThreadExecutor executor(3);
  std::vector<std::thread::id> who(3);
  std::atomic<int> arrived = 0;
  // Each task waits until all three run at once, which only three threads can do; the deadline keeps a defect finite.
  auto const deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  executor.for_each(3, [&](int i) {
    who[static_cast<std::size_t>(i)] = std::this_thread::get_id();
    ++arrived;
    while (arrived < 3 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  });
  CHECK((who[0] != who[1] && who[1] != who[2] && who[0] != who[2]));
}

TEST_CASE("an exception of a task reaches the caller and the team goes on working") {
  for (int const threads : {1, 2, 5}) {
    scarp::ThreadExecutor executor(threads);
    for (int round = 0; round < 20; ++round) {
      bool caught = false;
      try {
        executor.for_each(100, [&](int i) {
          if (i == 3 * round) throw std::runtime_error("task " + std::to_string(i));
        });
      } catch (std::runtime_error const& error) {
        caught = error.what() == "task " + std::to_string(3 * round);
      }
      CHECK(caught);
      CHECK(calls(executor, 50) == std::vector<int>(50, 1));
    }
    // When all tasks throw, one exception is passed on and none ends the program.
    CHECK_THROWS_AS(executor.for_each(100, [](int) { throw std::runtime_error("each"); }), std::runtime_error);
  }
}

TEST_CASE("an executor without work stops its threads when it ends") {
  for (int k = 0; k < 50; ++k) {
    auto const executor = std::make_unique<scarp::ThreadExecutor>(4);
    CHECK(executor->threads() == 4);
  }
}

TEST_CASE("a negative number of threads is refused and zero takes what the process may use") {
  CHECK_THROWS_WITH_AS(scarp::ThreadExecutor(-1), doctest::Contains("-1 threads"), scarp::InputError);
  scarp::ThreadExecutor const all(0);
  CHECK(all.threads() == scarp::usable_processors());
}

TEST_CASE("a task may ask the team for tasks of its own, and two threads may ask it at the same time") {
  scarp::ThreadExecutor executor(3);
  std::vector<std::atomic<int>> times(20 * 30);
  executor.for_each(
      20, [&](int i) { executor.for_each(30, [&](int k) { ++times[static_cast<std::size_t>(30 * i + k)]; }); });
  for (auto const& count : times) CHECK(count == 1);

  std::atomic<int> all = 0;
  auto const ask = [&] {
    for (int round = 0; round < 50; ++round) executor.for_each(40, [&](int) { ++all; });
  };
  std::thread other(ask);
  ask();
  other.join();
  CHECK(all == 2 * 50 * 40);
}

namespace {

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif
#else
constexpr bool sanitized = false;
#endif

/// What a child process writes that may have no more than so many bytes of addresses above those that it has; "killed"
/// when it does not end within 20 seconds.
template <class Action>
std::string within_memory(rlim_t more, Action const& action) {
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  pid_t const child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    alarm(20);
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit const limit{pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + more, RLIM_INFINITY};
    setrlimit(RLIMIT_AS, &limit);
    std::string const words = action();
    _exit(write(ends[1], words.data(), words.size()) == static_cast<ssize_t>(words.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string words;
  std::array<char, 256> part{};
  for (ssize_t got = 0; (got = read(ends[0], part.data(), part.size())) > 0;)
    words.append(part.data(), static_cast<std::size_t>(got));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? "killed" : words;
}

}  // namespace

TEST_CASE("threads that cannot be started end in words, not in a wait for ever" * doctest::skip(sanitized)) {
  // A thread has 8 MB of stack or so: some can be started, two hundred cannot.
  auto const words = within_memory(rlim_t{200} << 20U, [] {
    try {
      scarp::ThreadExecutor const executor(200);
      return std::string("all were started");
    } catch (scarp::InputError const& error) {
      return std::string(error.what());
    }
  });
  CHECK(words.find("200 threads were requested") != std::string::npos);
  CHECK(words.find("could be started") != std::string::npos);
}

TEST_CASE("more threads than there is memory to list are refused in words" * doctest::skip(sanitized)) {
  auto const words = within_memory(rlim_t{200} << 20U, [] {
    try {
      scarp::ThreadExecutor const executor(std::numeric_limits<int>::max());
      return std::string("all were started");
    } catch (scarp::InputError const& error) {
      return std::string(error.what());
    }
  });
  CHECK(words.find("could be started") != std::string::npos);
}

namespace {

/// Exit code of a forked process that runs an action; of a signal where it does not end within 20 seconds.
template <class Action>
int exit_code_of_child(Action const& action) {
  pid_t const child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    alarm(20);
    _exit(action());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

TEST_CASE("a team that was forked works with new threads, and ends" * doctest::skip(sanitized)) {
  auto const works = [](scarp::ThreadExecutor& executor) {
    return executor.threads() == 4 && calls(executor, 300) == std::vector<int>(300, 1);
  };
  auto executor = std::make_unique<scarp::ThreadExecutor>(4);
  REQUIRE(works(*executor));
  CHECK(exit_code_of_child([&] {
          bool const both = works(*executor) && works(*executor);
          int const below = exit_code_of_child([&] { return works(*executor) ? 5 : 1; });
          executor.reset();
          return both && below == 5 ? 7 : 1;
        }) == 7);
  CHECK(exit_code_of_child([&] {  // never used there
          executor.reset();
          return 7;
        }) == 7);
  CHECK(works(*executor));
}

TEST_CASE("a process forked from a task, and one forked while another thread works, have teams that work" *
          doctest::skip(sanitized)) {
  scarp::ThreadExecutor executor(3);
  std::atomic<int> code = 0;
  executor.for_each(9, [&](int i) {
    if (i == 4) code = exit_code_of_child([&] { return calls(executor, 40) == std::vector<int>(40, 1) ? 7 : 1; });
  });
  CHECK(code == 7);

  std::atomic<bool> begun = false, over = false;
  std::thread other([&] {
    executor.for_each(2, [&](int) {
      begun = true;
      while (!over) std::this_thread::yield();
    });
  });
  while (!begun) std::this_thread::yield();
  CHECK(exit_code_of_child([&] { return calls(executor, 40) == std::vector<int>(40, 1) ? 7 : 1; }) == 7);
  over = true;
  other.join();
}

TEST_CASE("a check of the caller ends tasks of all threads, also while the caller waits") {
  for (int const threads : {1, 2, 4}) {
    scarp::ThreadExecutor executor(threads);
    auto const caller = std::this_thread::get_id();
    std::atomic<int> begun = 0, done = 0;
    std::atomic<bool> over = false;
    std::function<void()> const check = [&] {
      if (std::this_thread::get_id() == caller && begun == threads) over = true;
      if (over) throw std::length_error("enough");
    };
    scarp::InterruptionCheck const checked(&check);
    CHECK_THROWS_AS(executor.for_each(threads,
                                      [&](int) {
                                        ++begun;
                                        bool const waits = std::this_thread::get_id() == caller && threads > 1;
                                        while (begun < threads) std::this_thread::yield();
                                        while (!waits) scarp::InterruptionCheck::run();
                                      }),
                    std::length_error);
    begun = 0, over = false;
    executor.for_each(10, [&](int) { ++done; });
    CHECK(done == 10);
  }
  CHECK(scarp::InterruptionCheck::now() == nullptr);
}

TEST_CASE("zero threads are no more than the process is bound to") {
  CHECK(exit_code_of_child([] {
          cpu_set_t bound;
          sched_getaffinity(0, sizeof bound, &bound);
          int last = CPU_SETSIZE - 1;
          while (!CPU_ISSET(last, &bound)) --last;
          CPU_ZERO(&bound);
          CPU_SET(last, &bound);
          sched_setaffinity(0, sizeof bound, &bound);
          return scarp::usable_processors();
        }) == 1);
}

TEST_CASE("tasks of one team may call another team, whose tasks call the first") {
  scarp::ThreadExecutor first(3);
  scarp::ThreadExecutor second(2);
  std::vector<std::atomic<int>> times(6 * 5 * 4);
  auto const around = [&](scarp::ThreadExecutor& outer, scarp::ThreadExecutor& inner) {
    outer.for_each(6, [&](int i) {
      inner.for_each(
          5, [&](int k) { outer.for_each(4, [&](int m) { ++times[static_cast<std::size_t>((i * 5 + k) * 4 + m)]; }); });
    });
  };
  around(first, second);
  for (auto const& count : times) CHECK(count == 1);
  // From two threads in opposite order: neither waits for the other's team.
  std::thread other([&] {
    for (int round = 0; round < 50; ++round) around(second, first);
  });
  for (int round = 0; round < 50; ++round) around(first, second);
  other.join();
  for (auto const& count : times) CHECK(count == 101);
}

// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "scarp/solver/thread_executor.hpp"

namespace {

static_assert(scarp::ExecutesTasks<scarp::SerialExecutor> && scarp::ExecutesTasks<scarp::ThreadExecutor>);
static_assert(!scarp::ExecutesTasks<std::vector<int>>, "what cannot run tasks is no executor");

/// How often each index in [0, count) was called.
template <class Executor>
std::vector<int> calls(Executor& executor, int count) {
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

TEST_CASE("a negative number of threads is refused and zero takes what the machine has") {
  CHECK_THROWS_WITH_AS(scarp::ThreadExecutor(-1), doctest::Contains("-1 threads"), scarp::InputError);
  scarp::ThreadExecutor const all(0);
  CHECK(all.threads() == std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
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

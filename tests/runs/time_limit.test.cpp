// SPDX-License-Identifier: BSL-1.0
#include "scarp/run/time_limit.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <vector>

#include "scarp/run/stop_signal.hpp"

TEST_CASE("a time limit counts from the moment that it is told, such as the start of a program") {
  auto const now = std::chrono::steady_clock::now();
  CHECK(scarp::TimeLimit(5.0, now - std::chrono::seconds(9)).wants_stop());
  CHECK_FALSE(scarp::TimeLimit(1e6, now - std::chrono::seconds(9)).wants_stop());
  CHECK_FALSE(scarp::TimeLimit(5.0).wants_stop());
  CHECK_FALSE(scarp::TimeLimit(0.0, now - std::chrono::seconds(9)).wants_stop());
}

static_assert(scarp::Described<scarp::StopSignal>, "a checkpointed run takes it among its observers");

TEST_CASE("a signal stops the runs of its time, and none that begins later") {
  for (int const number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU, SIGPIPE}) {
    CAPTURE(number);
    std::vector<scarp::StopSignal> copies;
    {
      scarp::StopSignal const first;
      CHECK_FALSE(first.wants_stop());
      copies.assign(2, first);
      std::raise(number);
    }
    CHECK(copies[0].wants_stop());
    copies.clear();
    CHECK_FALSE(scarp::StopSignal().wants_stop());
  }
}

TEST_CASE("the host's handlers of signals are back after a run, and one that ignores SIGHUP goes on to") {
  static int caught = 0;
  struct sigaction own {
  }, seen{};
  own.sa_sigaction = [](int, siginfo_t*, void*) { ++caught; };
  own.sa_flags = SA_SIGINFO;
  ::sigaction(SIGTERM, &own, nullptr);
  auto const before = std::signal(SIGHUP, SIG_IGN);
  {
    scarp::StopSignal const run;
    std::raise(SIGHUP);
    CHECK_FALSE(run.wants_stop());
    std::raise(SIGTERM);
    CHECK(run.wants_stop());
  }
  std::raise(SIGTERM);
  CHECK(caught == 1);
  ::sigaction(SIGTERM, nullptr, &seen);
  CHECK((seen.sa_flags & SA_SIGINFO) != 0);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGHUP, before);
}

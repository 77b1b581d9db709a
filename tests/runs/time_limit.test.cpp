// SPDX-License-Identifier: BSL-1.0
#include "scarp/run/time_limit.hpp"

#include <doctest/doctest.h>

#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "scarp/run/stop_signal.hpp"
#include "support/refusals.hpp"

TEST_CASE("a time limit counts from the moment that it is told, such as the start of a program") {
  auto const now = std::chrono::steady_clock::now();
  CHECK(scarp::TimeLimit(5.0, now - std::chrono::seconds(9)).wants_stop());
  CHECK_FALSE(scarp::TimeLimit(1e6, now - std::chrono::seconds(9)).wants_stop());
  CHECK_FALSE(scarp::TimeLimit(5.0).wants_stop());
  CHECK_FALSE(scarp::TimeLimit(0.0, now - std::chrono::seconds(9)).wants_stop());
}

TEST_CASE("a time limit that is negative or no number is refused") {
  CHECK_REFUSED(scarp::TimeLimit(-5.0), "time limit is -5");
  CHECK_REFUSED(scarp::TimeLimit(std::nan("")), "time limit is nan");
  CHECK_FALSE(scarp::TimeLimit(std::numeric_limits<double>::infinity()).wants_stop());
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

TEST_CASE("runs of two threads that begin and end at any moment have the handlers, and give them back") {
  auto const is_left = [] {
    struct sigaction now {};
    ::sigaction(SIGUSR2, nullptr, &now);
    return now.sa_handler == SIG_DFL;
  };
  REQUIRE(is_left());
  auto const runs = [&] {
    int lost = 0;
    for (int k = 0; k < 50000; ++k) {
      scarp::StopSignal const run;
      lost += is_left() ? 1 : 0;
    }
    return lost;
  };
  int of_other = 0;
  std::thread other([&] { of_other = runs(); });
  int const own = runs();
  other.join();
  CHECK(own + of_other == 0);
  CHECK(is_left());
}

TEST_CASE("what is being written when a signal comes is written whole") {
  scarp::StopSignal const run;
  std::array<int, 2> ends{};
  REQUIRE(::pipe(ends.data()) == 0);
  std::FILE* const out = ::fdopen(ends[1], "w");
  auto const writer = ::pthread_self();
  std::size_t received = 0;
  std::thread reader([&] {  // begins to read after the signal, which finds the writer before a full pipe
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ::pthread_kill(writer, SIGUSR1);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::array<char, 4096> text{};
    for (ssize_t count = 0; (count = ::read(ends[0], text.data(), text.size())) > 0;)
      received += static_cast<std::size_t>(count);
  });
  std::string const table(1 << 16, 'x');  // as much as a pipe holds
  for (int k = 0; k < 2; ++k) CHECK((std::fputs(table.c_str(), out) >= 0 && std::fflush(out) == 0));
  std::fclose(out);
  reader.join();
  ::close(ends[0]);
  CHECK(received == 2 * table.size());
  CHECK(run.wants_stop());
}

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <stdexcept>

#include "stability/stability_case.hpp"

namespace stability {

/// An outcome and what it cost.
struct Judged {
  Outcome outcome;
  double seconds = 0.0;  ///< CPU time
};

namespace detail {

inline void write_all(int to, std::string const& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    auto const count = write(to, text.data() + sent, text.size() - sent);
    if (count <= 0) _exit(3);
    sent += static_cast<std::size_t>(count);
  }
}

inline std::string read_all(int from) {
  std::string text;
  char block[4096];
  for (;;) {
    auto const count = read(from, block, sizeof block);
    if (count <= 0) return text;
    text.append(block, static_cast<std::size_t>(count));
  }
}

constexpr char separator = '\x1f';

inline std::string packed(Outcome const& outcome) {
  return fmt::format("{:d}{}{:.17g}{}{}{}{}", outcome.as_expected, separator, outcome.worst, separator, outcome.measure,
                     separator, outcome.remark);
}

inline Outcome unpacked(std::string const& text) {
  Outcome outcome;
  auto const first = text.find(separator);
  auto const second = text.find(separator, first + 1);
  auto const third = text.find(separator, second + 1);
  if (third == std::string::npos) return {.measure = "nothing", .remark = "ended without an answer"};
  outcome.as_expected = text[0] == '1';
  outcome.worst = std::strtod(text.c_str() + first + 1, nullptr);
  outcome.measure = text.substr(second + 1, third - second - 1);
  outcome.remark = text.substr(third + 1);
  return outcome;
}

inline Outcome answered(Case const& one, Size size) {
  try {
    Outcome outcome = one.run(size);
    if (!std::isfinite(outcome.worst)) {
      outcome.as_expected = false;
      outcome.remark += outcome.remark.empty() ? "not a finite number" : "; not a finite number";
    }
    return outcome;
  } catch (std::exception const& error) {
    return {.measure = "nothing", .remark = fmt::format("threw: {}", error.what())};
  }
}

}  // namespace detail

/// Runs a case in a process of its own: an exception, a crash and more CPU time than stated are failures, not the end.
/// \throws std::runtime_error where no process can be started
inline Judged in_a_process(Case const& one, Size size) {
  double const most_seconds = one.quick_seconds * (size == Size::quick ? 1.0 : 30.0);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to a case (the system refused): try again");
  pid_t const child = fork();
  if (child < 0) throw std::runtime_error("no process for a case (the system refused): try again");
  if (child == 0) {
    close(ends[0]);
    auto const whole = static_cast<rlim_t>(std::ceil(most_seconds));
    rlimit const limit{whole, whole + 5};
    setrlimit(RLIMIT_CPU, &limit);
    detail::write_all(ends[1], detail::packed(detail::answered(one, size)));
    _exit(0);
  }
  close(ends[1]);
  std::string const text = detail::read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  auto const seconds = [](timeval const& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  Judged judged{.outcome = {}, .seconds = seconds(used.ru_utime) + seconds(used.ru_stime)};
  if (WIFSIGNALED(status)) {
    judged.outcome.measure = "nothing";
    judged.outcome.remark = WTERMSIG(status) == SIGXCPU ? fmt::format("more than {} s of CPU time", most_seconds)
                                                        : fmt::format("crashed with signal {}", WTERMSIG(status));
  } else {
    judged.outcome = detail::unpacked(text);
  }
  return judged;
}

}  // namespace stability

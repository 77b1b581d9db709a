// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <exception>

#include "scarp/core/error.hpp"
#include "stability/stability_case.hpp"

namespace stability {

/// An outcome and its cost.
struct Judged {
  Outcome outcome;
  double seconds = 0.0;  ///< CPU time
};

/// Runs a case in a process of its own: an exception, a crash and CPU time beyond 20 s (600 s in full size) are
/// failures, not the end.
inline Judged in_a_process(Case const& one, Size size) {
  struct Shared {
    bool ended, as_expected;
    double worst;
    char measure[2000];
  };
  void* const memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  pid_t const child = memory == MAP_FAILED ? -1 : fork();
  if (child < 0) scarp::reject("no process for a case (fork failed): try again");
  auto& shared = *static_cast<Shared*>(memory);
  if (child == 0) {
    rlim_t const most = size == Size::quick ? 20 : 600;
    rlimit const limit{most, most + 5};
    setrlimit(RLIMIT_CPU, &limit);
    Outcome outcome{.measure = "nothing"};
    try {
      outcome = one.run(size);
    } catch (std::exception const& error) {
      outcome.measure = fmt::format("threw: {}", error.what());
    }
    shared.as_expected = outcome.as_expected && std::isfinite(outcome.worst);
    shared.worst = outcome.worst;
    auto const text = outcome.measure + (outcome.remark.empty() ? "" : "; ") + outcome.remark;
    std::strncpy(shared.measure, text.c_str(), sizeof shared.measure - 1);
    shared.ended = true;
    _exit(0);
  }
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  Judged judged{
      .outcome = {shared.as_expected, shared.worst, shared.measure, {}},
      .seconds = static_cast<double>(used.ru_utime.tv_sec) + 1e-6 * static_cast<double>(used.ru_utime.tv_usec)};
  if (!shared.ended) {
    judged.outcome.measure =
        WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU ? "too much CPU time" : fmt::format("crashed ({})", status);
  }
  munmap(memory, sizeof(Shared));
  return judged;
}

}  // namespace stability

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sys/resource.h>

namespace examples {

struct Usage {
  double cpu_seconds;
  double peak_memory_bytes;
};

/// What this process has taken so far.
inline Usage usage() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  auto const seconds = [](timeval const& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {seconds(used.ru_utime) + seconds(used.ru_stime), 1024.0 * static_cast<double>(used.ru_maxrss)};
}

}  // namespace examples

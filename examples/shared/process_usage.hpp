// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <type_traits>

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

/// What a run has taken, all processes together that have gone on with it; of the last, what came before it was killed.
class RunUsage {
 public:
  using Moment = std::chrono::steady_clock::time_point;

  /// started: when this process began
  explicit RunUsage(Moment started) : started_(started) {}

  double wall_seconds() const {
    return earlier_wall_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  }
  double cpu_seconds() const { return earlier_cpu_ + usage().cpu_seconds; }
  /// Of the process that has taken most.
  double peak_memory_bytes() const { return std::max(earlier_peak_, usage().peak_memory_bytes); }

  /// A checkpoint has the sums of all processes up to it.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    double wall = self.wall_seconds();
    double cpu = self.cpu_seconds();
    double peak = self.peak_memory_bytes();
    visit("wall_seconds", wall);
    visit("cpu_seconds", cpu);
    visit("peak_memory_bytes", peak);
    if constexpr (!std::is_const_v<Self>) {
      self.earlier_wall_ = wall;
      self.earlier_cpu_ = cpu;
      self.earlier_peak_ = peak;
    }
  }

 private:
  Moment started_;
  double earlier_wall_ = 0.0;
  double earlier_cpu_ = 0.0;
  double earlier_peak_ = 0.0;
};

}  // namespace examples

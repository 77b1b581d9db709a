// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "scarp/core/error.hpp"
#include "scarp/core/process.hpp"

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#endif

namespace scarp {

/// CPU time of the process since `start` [s], of all its threads together: other programs on the machine do not count.
class CpuTime {
 public:
  /// CPU time [s] since this object was made.
  double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

/// What the machine calls its processor; "unknown processor" where the system names none.
inline std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    auto const colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

/// Memory that the process may still allocate, and what sets the limit.
struct FreeMemory {
  double bytes = std::numeric_limits<double>::infinity();  ///< infinite where no limit is known
  std::string_view limit = "nothing known";                ///< name of what sets the limit

  /// Lowers the limit to `other` bytes where that is less; one that is not finite is ignored.
  void at_most(double other, std::string_view by) {
    if (std::isfinite(other) && other < bytes) *this = {std::max(0.0, other), by};
  }
};

namespace detail {

/// Memory [bytes] that the control groups of a process leave; see `least_of_groups`.
inline double group_memory(std::string const& groups, std::string const& mounted) {
  return least_of_groups(groups, mounted, "memory", [](auto const& file, bool is_second) {
    auto const present = [](double bytes) { return std::isfinite(bytes) ? bytes : 0.0; };  // not all kernels report all
    double const used = present(kernel_number(file(is_second ? "memory.current" : "memory.usage_in_bytes")));
    // The memory that caches the group's files can be freed.
    char const* const cache = is_second ? "inactive_file" : "total_inactive_file";
    double const taken = used - std::min(used, present(kernel_number(file("memory.stat"), cache)));
    return kernel_number(file(is_second ? "memory.max" : "memory.limit_in_bytes")) - taken;
  });
}

}  // namespace detail

/// The least of what the machine, the process's control group (containers, batch systems) and its limits leave.
inline FreeMemory free_memory() {
  constexpr double kilobyte = 1024.0;
  FreeMemory memory;
  memory.at_most(kilobyte * detail::kernel_number("/proc/meminfo", "MemAvailable:"), "the machine's memory");
  memory.at_most(detail::group_memory("/proc/self/cgroup", "/sys/fs/cgroup"), "the limit of the process's group");
#if __has_include(<sys/resource.h>)
  double const taken = kilobyte * detail::kernel_number("/proc/self/status", "VmSize:");
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
    memory.at_most(static_cast<double>(space.rlim_cur) - taken, "the limit of address space (ulimit -v)");
#endif
  return memory;
}

/// Such as "3.1 GB".
inline std::string memory_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

/// what: who needs it, with numbers; way_out: what to do with less
/// \throws InputError when more is needed than there is
inline void require_memory(std::string_view what, double bytes, std::string_view way_out,
                           FreeMemory const& memory = free_memory()) {
  if (!(bytes > memory.bytes)) return;
  reject("{} would need about {} of memory ({} are left by {}): {}", what, memory_text(bytes),
         memory_text(memory.bytes), memory.limit, way_out);
}

}  // namespace scarp

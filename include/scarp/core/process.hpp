// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif
#if __has_include(<sched.h>)
#include <sched.h>
#endif

#include "scarp/core/one_version.hpp"

namespace scarp {

namespace detail {

/// Differs between processes of a machine that live at the same time; 0 where the system has no such numbers.
inline long process_number() {
#if __has_include(<unistd.h>)
  return static_cast<long>(::getpid());
#else
  return 0;
#endif
}

/// The number behind a name in a file of the kernel's, or the file's only number; infinite without such a number.
inline double kernel_number(std::string const& file, std::string_view name = {}) {
  std::ifstream stream(file);
  for (std::string word; stream >> word;) {
    if (name.empty()) stream.seekg(0);
    if (!name.empty() && word != name) continue;
    double number = 0.0;
    return stream >> number ? number : std::numeric_limits<double>::infinity();
  }
  return std::numeric_limits<double>::infinity();
}

/// The least that the control groups of a process leave, from its own up to the outermost that is seen: of cgroup v2,
/// and of a controller of v1. Infinite where there is no limit.
/// groups: lines `number:controllers:/path` as in /proc/self/cgroup; mounted: folder of the groups
/// left(file, is_second): of one group, with file(name) the path of its files and whether it is of v2
template <class Left>
double least_of_groups(std::string const& groups, std::string const& mounted, std::string const& controller,
                       Left const& left) {
  double least = std::numeric_limits<double>::infinity();
  std::ifstream lines(groups);
  for (std::string line; std::getline(lines, line);) {
    auto const controllers = line.find(':') + 1;
    auto const path = line.find(':', controllers);
    if (controllers == 0 || path == std::string::npos) continue;
    std::istringstream names(line.substr(controllers, path - controllers));
    bool const is_second = path == controllers;
    bool is_wanted = is_second;
    for (std::string name; std::getline(names, name, ',');) is_wanted = is_wanted || name == controller;
    if (!is_wanted) continue;
    std::string root = mounted;
    if (!is_second) root.append("/").append(controller);
    std::filesystem::path group = line.substr(path + 1);
    for (bool above = true; above; group = group.parent_path()) {
      double const one = left([&](char const* name) { return (root + group.string()) + "/" + name; }, is_second);
      if (one < least) least = one;
      above = group.has_relative_path();
    }
  }
  return least;
}

/// Processors whose time the control groups of a process leave it, perhaps no whole number; see `least_of_groups`.
inline double group_processors(std::string const& groups, std::string const& mounted) {
  return least_of_groups(groups, mounted, "cpu", [](auto const& file, bool is_second) {
    double quota = 0.0, period = 0.0;
    if (is_second) {
      std::ifstream(file("cpu.max")) >> quota >> period;  // "max" in place of the quota is no number
    } else {
      quota = kernel_number(file("cpu.cfs_quota_us"));  // -1 without one
      period = kernel_number(file("cpu.cfs_period_us"));
    }
    return quota > 0.0 && period > 0.0 ? quota / period : std::numeric_limits<double>::infinity();
  });
}

}  // namespace detail

/// Processors that the process may use: those that it is bound to (taskset, batch systems), and no more than the quota
/// of its control group (containers) pays for, at least one.
inline int usable_processors() {
  int count = static_cast<int>(std::thread::hardware_concurrency());
#ifdef CPU_COUNT
  cpu_set_t bound;
  CPU_ZERO(&bound);
  if (::sched_getaffinity(0, sizeof bound, &bound) == 0) count = CPU_COUNT(&bound);
#endif
  double const quota = std::ceil(detail::group_processors("/proc/self/cgroup", "/sys/fs/cgroup"));
  return std::max(1, quota < count ? static_cast<int>(quota) : count);
}

/// The present moment in universal time, such as "2026-11-23T15:57:33Z" (ISO 8601).
inline std::string time_stamp() {
  std::time_t const now = std::time(nullptr);
  std::tm parts{};
#if defined(_WIN32)
  gmtime_s(&parts, &now);
#else
  gmtime_r(&now, &parts);
#endif
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

}  // namespace scarp

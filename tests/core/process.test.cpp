// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/process.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "support/files.hpp"

TEST_CASE("a number in a file of the kernel's is found by the name before it, or alone") {
  samples::ScratchFolder const folder;
  auto const number = [&](char const* text, std::string_view name) {
    std::ofstream(folder / "file") << text;
    return scarp::detail::kernel_number((folder / "file").string(), name);
  };
  constexpr char const* lines = "VmPeak: 12 kB\nVmSize: 34 kB\nend";
  CHECK(number(lines, "VmPeak:") == 12.0);
  CHECK(number(lines, "VmSize:") == 34.0);
  CHECK(std::isinf(number(lines, "VmData:")));
  CHECK(std::isinf(number(lines, "end")));
  CHECK(number("56\n", {}) == 56.0);
  CHECK(std::isinf(number("max\n", {})));
  CHECK(std::isinf(scarp::detail::kernel_number((folder / "none").string())));
}

TEST_CASE("the least quota of processors of the process's groups counts, of both versions of control groups") {
  samples::ScratchFolder const folder;
  auto const write = [&](std::string const& name, std::string const& text) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  };
  auto const left = [&] {
    return scarp::detail::group_processors((folder / "cgroup").string(), folder.path().string());
  };
  write("cgroup", "0::/pod/box\n7:cpuset:/x\n3:cpu,cpuacct:/slice\n");
  CHECK(std::isinf(left()));
  write("pod/box/cpu.max", "max 100000\n");
  CHECK(std::isinf(left()));
  write("pod/cpu.max", "350000 100000\n");
  CHECK(left() == 3.5);
  write("cpu/slice/cpu.cfs_quota_us", "-1\n");
  write("cpu/slice/cpu.cfs_period_us", "50000\n");
  CHECK(left() == 3.5);
  write("cpu/slice/cpu.cfs_quota_us", "75000\n");
  CHECK(left() == 1.5);
  // The outermost group counts too, and a line that names no controllers and path is passed over.
  write("cpu/cpu.cfs_quota_us", "12500\n");
  write("cpu/cpu.cfs_period_us", "50000\n");
  CHECK(left() == 0.25);
  write("cgroup", "nothing\n5:cpu\n0::/pod/box\n");
  CHECK(left() == 3.5);
}

TEST_CASE("a time stamp is the present moment in universal time") {
  std::time_t const before = std::time(nullptr);
  std::string const stamp = scarp::time_stamp();
  std::tm parts{};
  char zone = 0;
  REQUIRE(std::sscanf(stamp.c_str(), "%4d-%2d-%2dT%2d:%2d:%2d%c", &parts.tm_year, &parts.tm_mon, &parts.tm_mday,
                      &parts.tm_hour, &parts.tm_min, &parts.tm_sec, &zone) == 7);
  CHECK(stamp.size() == 20);
  CHECK(zone == 'Z');
  parts.tm_year -= 1900;
  parts.tm_mon -= 1;
  std::time_t const stamped = ::timegm(&parts);
  CHECK(stamped >= before);
  CHECK(stamped <= std::time(nullptr));
}

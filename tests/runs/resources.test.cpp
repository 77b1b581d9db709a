// SPDX-License-Identifier: BSL-1.0
#include "scarp/run/resources.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "support/files.hpp"
#include "support/refusals.hpp"

TEST_CASE("more memory than is left is refused with both numbers and a way out") {
  scarp::FreeMemory const memory{3e9, "the machine's memory"};
  CHECK_NOTHROW(scarp::require_memory("a mesh", 2.9e9, "choose a coarser one", memory));
  CHECK_REFUSED(scarp::require_memory("a mesh", 6.94e9, "choose a coarser one", memory), "a mesh", "6.9 GB", "3.0 GB",
                "the machine's memory", "choose a coarser one");
  CHECK(scarp::memory_text(12.3e6) == "12 MB");
}

TEST_CASE("the least limit counts, and what is not known limits nothing") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  scarp::FreeMemory memory;
  for (double const unknown : {infinity, -infinity, infinity - infinity}) memory.at_most(unknown, "nobody");
  CHECK(memory.bytes == infinity);
  memory.at_most(3e9, "one");
  memory.at_most(4e9, "another");
  CHECK(memory.bytes == 3e9);
  CHECK(memory.limit == "one");
  memory.at_most(-1.0, "what is taken already");
  CHECK(memory.bytes == 0.0);
}

TEST_CASE("what is left is known on this machine, and never more than the limit of address space leaves") {
#ifdef __linux__
  auto const memory = scarp::free_memory();
  CHECK(memory.bytes > 0.0);
  CHECK(memory.bytes < 1e15);
#endif
  int const child = ::fork();
  if (child == 0) {
    rlimit limit{};
    ::getrlimit(RLIMIT_AS, &limit);
    double const taken = 1024.0 * scarp::detail::kernel_number("/proc/self/status", "VmSize:");
    limit.rlim_cur = static_cast<rlim_t>(taken) + (64U << 20U);
    bool const set = ::setrlimit(RLIMIT_AS, &limit) == 0;
    auto const left = scarp::free_memory();
    ::_exit(set && left.bytes > 60e6 && left.bytes < 68e6 && left.limit.find("ulimit") != std::string_view::npos ? 7
                                                                                                                 : 1);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(WEXITSTATUS(status) == 7);
}

TEST_CASE("the least limit of the process's groups counts, of both versions of control groups") {
  samples::ScratchFolder const folder;
  auto const write = [&](std::string const& name, std::string const& text) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  };
  auto const left = [&] { return scarp::detail::group_memory((folder / "cgroup").string(), folder.path().string()); };
  CHECK(std::isinf(left()));
  write("cgroup", "0::/job/step\n4:cpuset,memory:/batch\n");
  CHECK(std::isinf(left()));
  write("job/step/memory.max", "max\n");
  write("job/step/memory.current", "1000\n");
  write("job/step/memory.stat", "anon 5\ninactive_file 0\n");
  CHECK(std::isinf(left()));
  write("job/memory.max", "9000\n");
  write("job/memory.current", "3000\n");
  write("job/memory.stat", "inactive_file 500\n");
  CHECK(left() == 6500.0);
  write("memory/memory.limit_in_bytes", "7000\n");
  write("memory/memory.usage_in_bytes", "3000\n");
  write("memory/memory.stat", "inactive_file 1\ntotal_inactive_file 100\n");
  CHECK(left() == 4100.0);
  write("job/memory.stat", "anon 5\n");
  write("memory/memory.limit_in_bytes", "99000\n");
  CHECK(left() == 6000.0);  // of a kernel that does not tell the cache
  std::filesystem::remove(folder / "job/memory.current");
  CHECK(left() == 9000.0);
}

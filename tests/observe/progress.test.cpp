// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/progress.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include "support/files.hpp"

namespace {

/// What a task writes to the error stream.
template <class Task>
std::string said(Task const& task) {
  samples::ScratchFolder const folder;
  std::fflush(stderr);
  int const before = ::dup(STDERR_FILENO);
  std::FILE* const file = std::fopen((folder / "said").c_str(), "w");
  ::dup2(::fileno(file), STDERR_FILENO);
  task();
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  std::fclose(file);
  return samples::content(folder / "said");
}

struct NoProblem {
  struct Grid {
    struct Site {
      scarp::Vector<2> position;
    };
    static Site site(int, double) { return {scarp::Vector<2>::Zero()}; }
  };
  static Grid grid() { return {}; }
  static std::string describe_dof(int) { return ""; }
};

}  // namespace

TEST_CASE("the time that remains is a number, also of ground that settles at a load") {
  for (double const to : {1.0, 0.5}) {
    CAPTURE(to);
    scarp::StepReport report;
    report.load = 0.5;
    auto const line = said([&] { scarp::Progress(to, {}).attempted(NoProblem{}, report); });
    CHECK(line.find("step    0  load 0.50000") == 0);
    CHECK(line.find("remaining    0.0 s\n") != std::string::npos);
  }
}

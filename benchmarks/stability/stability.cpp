// SPDX-License-Identifier: BSL-1.0
// Stiff and extreme cases: each has its expected response or status.
// stability [--quick] [PART OF A GROUP OR NAME...]; all cases write stability.csv
#define DOCTEST_CONFIG_IMPLEMENT  // without doctest's main(), but what it shares with the tests requires the rest
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "scarp/core/error.hpp"
#include "scarp/io/csv.hpp"
#include "shared/data_file.hpp"
#include "stability/in_a_process.hpp"

namespace {

using namespace stability;

int run(std::vector<std::string> const& arguments) {
  Size size = Size::full;
  std::vector<std::string> parts;
  for (auto const& argument : arguments) {
    if (argument == "--quick") {
      size = Size::quick;
    } else if (argument.starts_with("-")) {
      scarp::reject("option '{}' is not known: use --quick or parts of names", argument);
    } else {
      parts.push_back(argument);
    }
  }
  scarp::CsvTable table({"group", "case", "expected", "verdict", "worst", "measure", "CPU time [s]"});
  int count = 0;
  int failed = 0;
  Cases all;
  for (auto* const group :
       {grain_cases, rve_cases, strength_cases, mesh_cases, solver_cases, fault_cases, footing_cases}) {
    for (Case& one : group()) all.push_back(std::move(one));
  }
  for (auto const& one : all) {
    bool const chosen = parts.empty() || std::any_of(parts.begin(), parts.end(), [&](auto const& part) {
                          return (one.group + ": " + one.name).find(part) != std::string::npos;
                        });
    if (!chosen) continue;
    auto const [outcome, seconds] = in_a_process(one, size);
    ++count;
    failed += outcome.as_expected ? 0 : 1;
    table.add(one.group, one.name, one.expected, outcome.as_expected ? "as expected" : "failed", outcome.worst,
              outcome.measure, seconds);
    fmt::print(outcome.as_expected ? stderr : stdout, "{:<6} {:>8.2f} s  {}: {}: {:.3g}, {}\n",
               outcome.as_expected ? "ok" : "FAILED", seconds, one.group, one.name, outcome.worst, outcome.measure);
  }
  if (count == 0) scarp::reject("no case fits these names: use a part of a group or name");
  if (parts.empty()) benchmarks::write_data("stability", table.text());
  fmt::print("{} cases, {} not as expected\n", count, failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run({arguments + 1, arguments + count});
  } catch (std::exception const& error) {
    fmt::print(stderr, "stability: {}\n", error.what());
    return 2;
  }
}

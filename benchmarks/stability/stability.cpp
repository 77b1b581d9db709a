// SPDX-License-Identifier: BSL-1.0
// Which stiff and extreme cases does the library answer as it should?
// stability [--quick] [--list] [--page FILE] [--csv FILE] [--commit TEXT] [PART OF A GROUP OR NAME...]
#define DOCTEST_CONFIG_IMPLEMENT  // without doctest's main(), but what it shares with the tests asks for the rest
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>

#include "scarp/core/error.hpp"
#include "scarp/io/atomic_file.hpp"
#include "stability/groups.hpp"
#include "stability/page.hpp"

namespace {

using namespace stability;

/// What times are compared with: plain arithmetic of the kind that the library does. [s] of CPU time
double baseline() {
  constexpr int bodies = 1000;
  std::vector<double> x(bodies), y(bodies), force(bodies);
  for (int i = 0; i < bodies; ++i) {
    x[static_cast<std::size_t>(i)] = std::cos(1.7 * i);
    y[static_cast<std::size_t>(i)] = std::sin(2.3 * i);
  }
  std::clock_t const start = std::clock();
  for (int round = 0; round < 25; ++round) {
    for (std::size_t i = 0; i < bodies; ++i) {
      for (std::size_t j = 0; j < bodies; ++j) {
        double const dx = x[j] - x[i];
        double const dy = y[j] - y[i];
        double const squared = dx * dx + dy * dy + 1e-3;
        force[i] += dx / (squared * std::sqrt(squared));
      }
    }
    x[0] += 1e-30 * force[bodies - 1];  // the rounds depend on each other
  }
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

struct Choice {
  Size size = Size::full;
  bool list = false;
  std::string page;
  std::string csv;
  std::string commit = "not stated";
  std::string command = "./benchmarks/stability/run";
  std::vector<std::string> parts;

  bool takes(Case const& one) const {
    for (auto const& part : parts) {
      if (one.group.find(part) != std::string::npos || one.name.find(part) != std::string::npos) return true;
    }
    return parts.empty();
  }
};

Choice choice_of(std::vector<std::string> const& arguments) {
  Choice choice;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    auto const& argument = arguments[i];
    if (argument == "--quick") {
      choice.size = Size::quick;
    } else if (argument == "--list") {
      choice.list = true;
    } else if (argument == "--page" || argument == "--csv" || argument == "--commit") {
      if (++i == arguments.size())
        scarp::refuse("{} is not followed by anything (a text is missing): give one", argument);
      (argument == "--page" ? choice.page : argument == "--csv" ? choice.csv : choice.commit) = arguments[i];
    } else if (argument.starts_with("-")) {
      scarp::refuse("option '{}' is not known: use --quick, --list, --page, --csv, --commit or parts of names",
                    argument);
    } else {
      choice.parts.push_back(argument);
    }
  }
  if (choice.size == Size::quick) choice.command += " --quick";
  for (auto const& part : choice.parts) choice.command += fmt::format(" '{}'", part);
  return choice;
}

int run(Choice const& choice) {
  Cases cases;
  for (Case& one : all_cases()) {
    if (choice.takes(one)) cases.push_back(std::move(one));
  }
  if (cases.empty()) scarp::refuse("no case fits these names (see --list): use a part of a group or name");
  if (choice.list) {
    for (auto const& one : cases) fmt::print("{}: {}: {}\n", one.group, one.name, one.expected);
    return 0;
  }
  Origin const origin{.commit = choice.commit, .command = choice.command, .baseline = std::max(baseline(), 1e-3)};
  std::vector<Judged> judged;
  std::size_t failed = 0;
  for (auto const& one : cases) {
    judged.push_back(in_a_process(one, choice.size));
    auto const& [outcome, seconds] = judged.back();
    failed += outcome.as_expected ? 0 : 1;
    fmt::print("{:<6} {:>8.2f} s  {}: {}: {} {:.3g}{}{}\n", outcome.as_expected ? "ok" : "FAILED", seconds, one.group,
               one.name, outcome.measure, outcome.worst, outcome.remark.empty() ? "" : "; ", outcome.remark);
    std::fflush(stdout);
  }
  if (!choice.page.empty()) scarp::write_file(choice.page, page(cases, judged, origin));
  if (!choice.csv.empty()) scarp::write_file(choice.csv, table(cases, judged, origin));
  fmt::print("{} cases, {} not as expected\n", cases.size(), failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run(choice_of({arguments + 1, arguments + count}));
  } catch (std::exception const& error) {
    fmt::print(stderr, "stability: {}\n", error.what());
    return 2;
  }
}

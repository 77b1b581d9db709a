// SPDX-License-Identifier: BSL-1.0
// Which error does a setting leave, and what does it cost? Packings, boundary-value problems, the fault scene, a
// user-defined scene.
#include <algorithm>
#include <exception>
#include <string_view>

#include "../shared/data_file.hpp"
#include "subjects.hpp"

namespace {

using error_vs_time::Options;
using error_vs_time::Subject;

constexpr std::string_view usage =
    "usage: error_vs_time [SUBJECT...] [--repetitions N] [--quick]   (without SUBJECT: all)\n";

/// \throws InputError for what is no option and no subject
std::vector<Subject> read(int count, char const* const* arguments, Options& options) {
  std::vector<Subject> chosen;
  for (int k = 1; k < count; ++k) {
    std::string_view const argument = arguments[k];
    if (argument == "--quick") {
      options.quick = true;
    } else if (argument == "--repetitions" && k + 1 < count) {
      options.repetitions = scarp::require_at_least("--repetitions", std::atoi(arguments[++k]), 1);
    } else {
      auto const& all = error_vs_time::subjects();
      auto const found = std::find_if(all.begin(), all.end(), [&](auto const& each) { return each.name == argument; });
      if (found == all.end())
        scarp::reject("no subject or option '{}' (or its value is missing): see --help", argument);
      chosen.push_back(*found);
    }
  }
  return chosen.empty() ? error_vs_time::subjects() : chosen;
}

/// The front of each response, a line each, at most twelve.
std::string fronts(error_vs_time::SweepTable const& table) {
  std::string text;
  std::size_t lines = 0;
  for (auto const& response : table.responses) {
    if (lines++ == 12) break;
    text += fmt::format("{}: base {:.2g} %; front", response, 100.0 * table.rows.front().errors[lines - 1]);
    for (auto const& row : table.front(response)) {
      text += fmt::format("; {} {} ({:.2g} %, cost {:.2g})", row.knob, row.setting, 100.0 * row.errors[lines - 1],
                          row.cost);
    }
    text += "\n";
  }
  return text;
}

void report(Options const& options, Subject const& subject) {
  auto const table = subject.run(options);
  auto const reference = std::isfinite(table.reference_cost)
                             ? fmt::format("reference {:.3g} times that", table.reference_cost)
                             : std::string("exact reference");
  auto const more = fmt::format("{} repetitions; base setting {:.3g} s, {}; costs differ by {:.2g} % by chance",
                                table.repetitions, table.rows.front().seconds, reference, 100.0 * table.cost_noise);
  benchmarks::write_data("error_vs_time_" + subject.name, table.csv(), more, fronts(table));
}

}  // namespace

int main(int argc, char** argv) {
  auto& all = error_vs_time::subjects();
  std::sort(all.begin(), all.end(), [](auto const& a, auto const& b) { return a.name < b.name; });
  if (argc == 2 && (std::string_view(argv[1]) == "--help" || std::string_view(argv[1]) == "-h")) {
    fmt::print("{}subjects:\n", usage);
    for (auto const& subject : all) fmt::print("  {:<24} {}\n", subject.name, subject.question);
    return 0;
  }
  try {
    Options options;
    for (auto const& subject : read(argc, argv, options)) report(options, subject);
  } catch (std::exception const& problem) {
    fmt::print(stderr, "error_vs_time: {}\n", problem.what());
    return 1;
  }
  return 0;
}

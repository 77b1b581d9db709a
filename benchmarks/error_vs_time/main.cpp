// SPDX-License-Identifier: BSL-1.0
// What error does which setting leave, and what does it cost? Packings, boundary-value problems and providers.
#include <algorithm>
#include <charconv>
#include <exception>
#include <string_view>

#include "report.hpp"

namespace {

using error_vs_time::Options;
using error_vs_time::Subject;

constexpr std::string_view usage =
    "usage: error_vs_time [SUBJECT...] [--out FOLDER] [--repetitions N] [--quick]   (without SUBJECT: all)\n";

/// \throws InputError for what is no option and no subject
std::vector<Subject> read(int count, char const* const* arguments, Options& options) {
  std::vector<Subject> chosen;
  for (int k = 1; k < count; ++k) {
    std::string_view const argument = arguments[k];
    bool const has_value = k + 1 < count;
    if (argument == "--quick") {
      options.quick = true;
    } else if (argument == "--out" && has_value) {
      options.out = arguments[++k];
    } else if (argument == "--repetitions" && has_value) {
      std::string_view const text = arguments[++k];
      auto const [end, trouble] = std::from_chars(text.data(), text.data() + text.size(), options.repetitions);
      if (trouble != std::errc{} || end != text.data() + text.size() || options.repetitions < 1) {
        scarp::refuse("--repetitions '{}' is no number of runs (one at least): give 3", text);
      }
    } else {
      auto const& all = error_vs_time::subjects();
      auto const found = std::find_if(all.begin(), all.end(), [&](auto const& each) { return each.name == argument; });
      if (found == all.end())
        scarp::refuse("no subject or option '{}' (or its value is missing): see --help", argument);
      chosen.push_back(*found);
    }
  }
  return chosen.empty() ? error_vs_time::subjects() : chosen;
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
    auto const chosen = read(argc, argv, options);
    std::filesystem::create_directories(options.out);
    for (auto const& subject : chosen) report(subject, options, subject.run(options));
  } catch (std::exception const& problem) {
    fmt::print(stderr, "error_vs_time: {}\n", problem.what());
    return 1;
  }
  return 0;
}

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "print.hpp"

namespace examples {

/// Names before version 0.2, which accepts them with a warning; version 0.3 will not.
struct RenamedOption {
  std::string_view before;
  std::string_view now;
};
inline constexpr RenamedOption renamed_options[] = {
    {"triangles", "elements"},
    {"preload", "overconsolidation-ratio"},
    {"peak-friction", "peak-friction-angle"},
    {"peak-dilation", "peak-dilation-angle"},
    {"residual-friction", "residual-friction-angle"},
    {"strain-to-residual", "softening-strain"},
    {"largest-gradient", "max-displacement-gradient"},
    {"most-iterations", "max-iterations"},
    {"strain-per-step", "strain-per-dem-step"},
    {"least-dem-steps", "min-dem-steps"},
    {"unbalanced", "unbalanced-tolerance"},
    {"budget-companions", "sensitivity-runs"},
    {"companions", "sensitivity-file"},
    {"gate", "max-error"},
    {"cut-gate", "max-cut-error"},
    {"slide-gate", "max-slide-error"},
    {"cylinder-gate", "max-cylinder-error"},
    {"opening-gate", "max-opening-error"},
    {"halvings", "max-halvings"},
};

/// The name that an option of this program has now; not of its subcommands, which have none of these.
inline std::string present_name(CLI::App const& app, std::string const& name) {
  auto const* const found = std::ranges::find(renamed_options, std::string_view(name), &RenamedOption::before);
  if (found == std::end(renamed_options)) return name;
  std::string const now(found->now);
  if (app.get_option_no_throw("--" + name) != nullptr || app.get_option_no_throw("--" + now) == nullptr) return name;
  print(stderr, "warning: --{} is now --{} (the old name ends with version 0.3): use the new name\n", name, now);
  return now;
}

/// The present value of an option for one of before version 0.2.
inline std::string present_value(std::string_view option, std::string value) {
  if (option != "footing" || value != "sticking") return value;
  print(stderr,
        "warning: --footing sticking is now --footing tied (the old value ends with version 0.3): use the new one\n");
  return "tied";
}

/// CLI11 takes 010 for eight and 0x10 for sixteen, files of sands for ten and for nothing.
inline void require_decimal(CLI::App& app) {
  CLI::Validator const decimal(
      [](std::string& given) {
        auto const digits = given.find_first_not_of("+-");
        bool const fits = digits == std::string::npos || given[digits] != '0' || digits + 1 == given.size();
        return fits ? std::string()
                    : fmt::format("'{}' begins with a zero (a decimal whole number is expected): leave it out", given);
      },
      "");
  auto const is_whole = [](CLI::Option const* one) {
    return one->get_type_name().starts_with("INT") || one->get_type_name().starts_with("UINT");
  };
  for (CLI::Option* option : app.get_options(is_whole)) option->check(decimal);
  for (CLI::App* command : app.get_subcommands({})) require_decimal(*command);
}

/// Reads the command line, also with options by their names from before. \throws CLI::ParseError
inline void parse(CLI::App& app, int argc, char** argv) {
  app.name(argv[0]);
  require_decimal(app);
  std::vector<std::string> words(argv + 1, argv + argc);
  std::string last;  // option whose value may follow
  for (auto& word : words) {
    if (!word.starts_with("--")) {
      word = present_value(std::exchange(last, {}), std::move(word));
      continue;
    }
    auto const end = std::min(word.find('='), word.size());
    last = present_name(app, word.substr(2, end - 2));
    word = "--" + last + (end < word.size() ? "=" + present_value(last, word.substr(end + 1)) : "");
  }
  std::ranges::reverse(words);
  app.parse(std::move(words));
}

}  // namespace examples

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "print.hpp"
#include "scarp/core/build_info.hpp"
#include "scarp/run/resources.hpp"
#include "scarp/run/run_folder.hpp"
#include "write_json.hpp"

namespace examples {

/// Where a program writes its results.
struct Output {
  std::string folder;
  bool overwrite = false;
};

inline CLI::Option* declare_output(CLI::App& app, Output& output, std::string const& what,
                                   std::string const& names = "--output") {
  auto* const option =
      app.add_option(names, output.folder, what)->check([](std::string const& given) { return folder_problem(given); });
  app.add_flag("--overwrite", output.overwrite, "results that are there already may be replaced")->configurable(false);
  return option;
}

/// An option whose values have names; reports use these names, not numbers.
template <class Enum, class Member>
CLI::Option* add_named(CLI::App& app, std::string const& option, Member& member, std::string const& what,
                       std::vector<std::pair<std::string, Enum>> const& names) {
  std::vector<std::string> words;
  std::string chosen;
  for (auto const& [word, value] : names) {
    words.push_back(word);
    if (member == value) chosen = word;
  }
  auto const take = [&member, names](std::string const& given) {
    for (auto const& [word, value] : names) {
      if (word == given) member = value;
    }
  };
  return app.add_option_function<std::string>(option, take, what)
      ->check(CLI::IsMember(std::move(words)).description(""))
      ->default_str(chosen);
}

/// What an option was given or takes by itself.
inline std::string value_of(CLI::Option const& option) {
  bool const is_flag = option.get_items_expected_max() == 0;
  if (is_flag) return option.count() > 0 && option.as<bool>() ? "true" : "false";
  return option.count() > 0 ? CLI::detail::join(option.results(), ",") : option.get_default_str();
}

/// All options of a program, or of one of its commands.
inline scarp::RunRecord::Lines all_options(CLI::App const& app) {
  scarp::RunRecord::Lines lines;
  for (CLI::Option const* option : app.get_options()) {
    if (option == app.get_help_ptr() || option == app.get_version_ptr()) continue;
    lines.emplace_back(option->get_single_name(), value_of(*option));
  }
  return lines;
}

/// What these would be if none had been given.
inline scarp::RunRecord::Lines default_options(CLI::App const& app) {
  auto lines = all_options(app);
  for (auto& [name, value] : lines) {
    auto const* const option = app.get_option_no_throw("--" + name);
    if (option != nullptr) value = option->get_items_expected_max() == 0 ? "false" : option->get_default_str();
  }
  return lines;
}

/// Of the source that this was built from; "unknown" outside of a repository.
std::string_view commit();

/// How the source that includes this was compiled; clang++ 14 accepts no immediate function as a default argument.
static constexpr scarp::BuildInfo build_of_source = scarp::build_info();

/// Description of a run by the program that begins it.
/// app: with the run's options
inline scarp::RunRecord record_of(std::string program, CLI::App const& app,
                                  scarp::BuildInfo const& build = build_of_source) {
  scarp::RunRecord record{.program = std::move(program), .options = all_options(app), .defaults = default_options(app)};
  record.build = {{"version", std::string(scarp::version)},
                  {"commit", std::string(commit())},
                  {"compiler", scarp::described(build)},
#ifdef SCARP_PRECOMPILED
                  {"compiler of the library", scarp::described(scarp::library_build())},
#endif
                  {"processor", scarp::processor()}};
  return record;
}

/// For a program's summary.json.
inline nlohmann::ordered_json json_of(scarp::RunRecord const& record) {
  nlohmann::ordered_json json{{"program", record.program}, {"identity", record.identity}, {"started", record.started}};
  for (auto const& [name, value] : record.build) json[name] = value;
  for (auto const& [name, value] : record.options) json["options"][name] = value;
  return json;
}

/// What was requested in numbers that memory depends on.
inline std::string requested_sizes(CLI::App const& app) {
  std::string text;
  for (char const* name : {"elements", "size", "columns", "rows", "cells", "mesh", "grains", "packings", "seeds"}) {
    for (auto const& [option, value] : all_options(app)) {
      if (option == name && !value.empty()) text += fmt::format("{}--{} {}", text.empty() ? "" : " ", name, value);
    }
  }
  return text;
}

/// Prints the reason why a program ends with an exception.
/// \return its exit code: 2 for a folder, checkpoint or other input that is rejected, else 1
inline int ended_by(std::exception const& problem, std::string const& program, CLI::App const& app) {
  if (dynamic_cast<std::bad_alloc const*>(&problem) != nullptr) {
    examples::print(stderr, "{}: out of memory (requested: {}): request less\n", program, requested_sizes(app));
  } else {
    examples::print(stderr, "{}: {}\n", program, problem.what());
  }
  return dynamic_cast<scarp::InputError const*>(&problem) != nullptr ? 2 : 1;
}

}  // namespace examples

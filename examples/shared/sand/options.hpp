// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "../command_line.hpp"
#include "sand_file.hpp"

namespace examples {

/// Whether an option of a name stands on the command line or in the configuration file.
inline IsGiven given_in(CLI::App const& app) {
  return [&app](std::string const& name) {
    auto const* const option = app.get_option_no_throw("--" + name);
    return option != nullptr && option->count() > 0;
  };
}

inline CLI::Option* declare_sand_file(CLI::App& app, std::string& file) {
  return app
      .add_option("--sand", file,
                  "file with lines `option = value`: grains, contacts and preparation of a sand (examples/sands); "
                  "options that are given count before its values")
      ->check(CLI::ExistingFile);
}

/// All options of a sand. Groups: Material, and Preparation for what a prepared packing has no use for.
inline void declare_sand(CLI::App& app, Sand& sand) {
  bool material = true;
  for_each_option(sand, [&](std::string const& name, auto& member, Range range, char const* what) {
    using Member = std::remove_reference_t<decltype(member)>;
    if (is_of_file(name)) return;
    if (name == "smallest") material = false;
    auto const names = name == "void-ratio" ? "--void-ratio,--target-void-ratio" : "--" + name;
    auto* const option = app.add_option(names, member, what)->group(material ? "Material" : "Preparation");
    if (name == "shape") option->check(CLI::IsMember({"disc", "ellipse", "superellipse", "sphere"}).description(""));
    if (name == "law") option->check(CLI::IsMember({"linear", "hertz", "rolling", "rolling-hertz"}).description(""));
    if (name == "seed") option->check(seed_number());
    if constexpr (std::is_same_v<Member, int>)
      option->check(CLI::Range(static_cast<int>(range.least), static_cast<int>(range.most)));
    if constexpr (std::is_same_v<Member, double>) option->check(number_from(range.least, range.inclusive, range.most));
  });
  for (char const* one : {"--preparation-friction", "--void-ratio"}) {
    for (char const* other : {"--void-ratio", "--relative-density"}) {
      if (std::string_view(one) != other) app.get_option(one)->excludes(app.get_option(other));
    }
  }
}

/// \throws InputError for an option that was given and is not used
inline void reject_unused(CLI::App const& app, std::string const& name, std::string_view why) {
  if (!why.empty() && given_in(app)(name)) scarp::reject("--{} is given but not used ({}): leave it out", name, why);
}

/// \throws InputError for options of a sand that it has no use for
inline void require_used(CLI::App const& app, Sand const& sand) {
  for_each_option(sand, [&](std::string const& name, auto const&, Range, char const*) {
    reject_unused(app, name, why_unused(sand, name));
  });
}

/// What a sand consists of, by the names of its options.
inline nlohmann::json to_json(Sand const& sand) {
  nlohmann::json json;
  for_each_option(sand, [&](std::string const& name, auto const& member, Range, char const*) {
    if (why_unused(sand, name).empty()) json[name] = member;
  });
  return json;
}

}  // namespace examples

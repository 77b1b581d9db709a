// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "print.hpp"
#include "renamed_options.hpp"
#include "scarp/io/text_lines.hpp"

namespace examples {

/// Rejects NaN, infinity and text; CLI11's own range checks let NaN pass.
inline CLI::Validator number_from(double least, bool inclusive, double most) {
  auto const text = fmt::format("FLOAT {} {}, at most {}", inclusive ? "from" : "above", least, most);
  return CLI::Validator(
      [=](std::string& given) {
        double value = 0.0;
        bool const fits = CLI::detail::lexical_cast(given, value) && std::isfinite(value) &&
                          (inclusive ? value >= least : value > least) && value <= most;
        return fits ? std::string()
                    : fmt::format("'{}' is out of range (it must be a number {} {} and at most {})", given,
                                  inclusive ? "from" : "above", least, most);
      },
      text);
}

/// What stands between the commas; CLI11's own delimiter drops what is empty.
inline std::vector<std::string> list_items(std::string const& given) {
  std::vector<std::string> items(1);
  for (char const letter : given) {
    if (letter == ',') {
      items.emplace_back();
    } else {
      items.back() += letter;
    }
  }
  return items;
}

/// Checks a list a,b,c item by item.
inline CLI::Validator each_of_list(CLI::Validator const& check) {
  return CLI::Validator(
      [=](std::string& given) {
        for (auto& item : list_items(given)) {
          if (auto const problem = check(item); !problem.empty()) return problem;
        }
        return std::string();
      },
      check.get_description());
}

/// A whole number, from 0, of at most fifteen digits.
inline CLI::Validator seed_number() {
  return CLI::Validator(
      [](std::string& given) {
        bool const fits =
            !given.empty() && given.size() <= 15 && given.find_first_not_of("0123456789") == std::string::npos;
        return fits ? std::string()
                    : fmt::format("'{}' is no seed (it must be a whole number, from 0, of at most 15 digits)", given);
      },
      "SEED");
}

/// Files with lines `option = value`: a value may hold commas, lines end as TextLines has them.
class ConfigFile : public CLI::ConfigTOML {
 public:
  /// app: whose options the file names
  explicit ConfigFile(CLI::App const& app) : app_(app) { arraySeparator = '\x1f'; }

  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
    std::string const text(std::istreambuf_iterator<char>(input), {});
    std::stringstream plain;
    for (scarp::TextLines lines(text); !lines.done();) plain << lines.take() << '\n';
    auto found = CLI::ConfigTOML::from_config(plain);
    if (found.empty())
      throw CLI::ConfigError(
          fmt::format("--config: the file has no options ({}): write one, or leave --config out", expected()));
    for (auto& item : found) {
      CLI::App const& command = command_of(item);
      item.name = present_name(command, item.name);
      bool const is_section = item.name == "++" || item.name == "--";  // its begin and end
      if (!is_section && command.get_option_no_throw("--" + item.name) == nullptr)
        throw CLI::ConfigError(fmt::format("'{}' is no option ({}): see --help", item.name, expected()));
      for (auto& value : item.inputs) value = present_value(item.name, value);
    }
    return found;
  }

 private:
  /// \throws CLI::ConfigError for a section that is no command of the program
  CLI::App const& command_of(CLI::ConfigItem const& item) const {
    CLI::App const* command = &app_;
    for (auto const& section : item.parents) {
      auto const named = command->get_subcommands([&](CLI::App const* one) { return one->get_name() == section; });
      if (named.empty())
        throw CLI::ConfigError(fmt::format("'{}' is no section ({}): leave it out", section, expected()));
      command = named.front();
    }
    return *command;
  }
  char const* expected() const {
    return app_.get_subcommands({}).empty() ? "lines `option = value` are expected"
                                            : "sections named as commands with lines `option = value` are expected";
  }

  CLI::App const& app_;
};

/// One with an unknown option is rejected when it is read.
inline void declare_config(CLI::App& app, std::string const& what = "file with lines `option = value`") {
  app.set_config("--config", "", what);
  app.config_formatter(std::make_shared<ConfigFile>(app));
  app.allow_config_extras(CLI::config_extras_mode::error);
}

/// Names the options that were given and that nothing uses.
inline void warn_of_unused(CLI::App const& app, char const* why, std::initializer_list<char const*> options) {
  for (auto const* option : options) {
    if (app.count(option) > 0) print(stderr, "warning: {} has no effect ({}): leave it out\n", option, why);
  }
}

/// Why a folder cannot take results, or nothing. The folder itself, and what it lies in, are made when results are
/// written.
inline std::string folder_problem(std::string const& given) {
  if (given.empty()) return "the name of the output folder is empty";
  std::error_code trouble;
  auto place = std::filesystem::absolute(given, trouble).lexically_normal();
  for (; !trouble && place.has_relative_path(); place = place.parent_path()) {
    auto const kind = std::filesystem::status(place, trouble).type();
    if (kind == std::filesystem::file_type::directory) return {};
    if (kind == std::filesystem::file_type::none) break;
    if (kind != std::filesystem::file_type::not_found)
      return place == std::filesystem::absolute(given).lexically_normal()
                 ? "'" + given + "' is a file"
                 : "'" + given + "' cannot be made ('" + place.string() + "' is a file): choose another folder";
    trouble.clear();  // of what is not there
  }
  if (!trouble) return {};
  return "'" + given + "' cannot be reached (" + trouble.message() + "): check the folders that it lies in";
}

}  // namespace examples

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "renamed_options.hpp"
#include "scarp/core/build_info.hpp"

namespace examples {

/// What --version prints.
/// build: of the source that has `main`; flags belong to a source
inline std::string version_text(scarp::BuildInfo const& build) {
  std::string text = "scarp " + std::string(scarp::version) + "\nprogram: " + scarp::described(build);
#ifdef SCARP_PRECOMPILED
  text += "\nscarp::precompiled: " + scarp::described(scarp::library_build());
#endif
  if (auto const note = scarp::slow_build_note(build); !note.empty()) text.append("\n").append(note);
  return text;
}

/// Option --version: prints version, compiler and instruction set, and ends the program with 0.
inline void declare_version(CLI::App& app) {
  constexpr auto build = scarp::build_info();
  app.set_version_flag(
      "--version", [build] { return version_text(build); }, "version, compiler and instruction set");
}

/// Reads the command line.
/// \return exit code when the program is to end: 0 after --help and the like, 2 for options that are rejected
inline std::optional<int> ended_by_options(CLI::App& app, int argc, char** argv) {
  try {
    parse(app, argc, argv);
  } catch (CLI::ParseError const& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  return std::nullopt;
}

/// For programs that have no other options than --help and --version.
/// \return exit code when the program is to end
inline std::optional<int> ended_without_options(int argc, char** argv, std::string const& question) {
  CLI::App app(question);
  declare_version(app);
  return ended_by_options(app, argc, argv);
}

}  // namespace examples

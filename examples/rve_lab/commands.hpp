// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "choices.hpp"

namespace rve_lab {

/// Each command has a record of its own, so that a packing is prepared and sheared in one folder.
inline scarp::RunFolder folder_of(examples::Output const& output, CLI::App const& app,
                                  std::vector<std::string> results) {
  return {{.folder = output.folder,
           .overwrite = output.overwrite,
           .record = "run_" + app.get_name() + ".json",
           .results = std::move(results)},
          examples::record_of("rve_lab " + app.get_name(), app)};
}

/// Takes files of an older run away when a new one begins: one that fails leaves no old results beside new ones.
/// inputs: files that the run reads; they stay
/// \throws FileError for one that cannot be removed
inline void remove_older(scarp::RunFolder const& own, std::vector<std::string> const& names,
                         std::vector<std::filesystem::path> const& inputs = {}) {
  for (auto const& name : names) {
    auto const file = own.path() / name;
    std::error_code trouble;
    bool const is_input = std::ranges::any_of(inputs, [&](auto const& input) {
      std::error_code missing;
      return std::filesystem::equivalent(file, input, missing) && !missing;
    });
    if (!is_input) std::filesystem::remove(file, trouble);
    if (trouble)
      throw scarp::FileError(fmt::format("cannot remove '{}' of an older run ({}): remove it, or choose another folder",
                                         file.string(), trouble.message()));
  }
}

/// Makes a packing and writes it with its sand and its tables.
/// \throws InputError, PreparationError, FileError, as the other commands
void prepare(Test& choice, CLI::App const& app);
void declare_prepare(CLI::App& app, Test& choice);

/// Prepares or reads a packing and sends it along a path.
void shear(Test& choice, CLI::App const& app);
void declare_shear(CLI::App& app, Test& choice);

/// Finds the free parameters of a sand by targets and tables. In the folder: evaluations.csv, calibrated.sand,
/// curve.csv, calibration.csv, sensitivities.csv, summary.json.
/// \throws InputError for targets out of reach, naming what limits them
void calibrate(CalibrateChoice choice, CLI::App const& app);
void declare_calibrate(CLI::App& app, CalibrateChoice& choice);

/// Tests a material as a laboratory does.
/// \return whether the test came to its end
bool test(Laboratory& choice, CLI::App const& app);
void declare_test(CLI::App& app, Laboratory& choice);
/// \throws InputError for options that the material or the path has no use for
void require_used(CLI::App const& app, Laboratory const& choice);

/// Sends the packing of another code along a path.
void replay(Replay choice, CLI::App const& app);
void declare_replay(CLI::App& app, Replay& choice);

}  // namespace rve_lab

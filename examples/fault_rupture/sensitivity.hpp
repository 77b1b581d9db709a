// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "../shared/study/choice.hpp"
#include "scarp/budget/budget_part.hpp"
#include "scarp/run/run_record.hpp"

namespace fault_rupture {

/// The scene once more with one other choice, whose effect on the result it estimates.
struct SensitivityRun {
  std::string part;                 ///< of the error budget
  scarp::RunRecord::Lines options;  ///< those that are other
  Choice choice;
};

/// What is other, as on a command line.
std::string command_options(SensitivityRun const& run);

/// A mesh of as many elements with other directions, unless the mesh comes from a file; load steps of half the size.
/// max_displacement_gradient: that limits the scene's load steps
std::vector<SensitivityRun> sensitivity_runs_of(Choice const& choice, double max_displacement_gradient);

/// The same with a limit of its load steps half as large, where that of the others was hardly ever met.
SensitivityRun with_smaller_steps(SensitivityRun run);

/// What a sensitivity run came to, by its part of the budget.
struct SensitivityResult {
  double surface_x50 = 0.0;  ///< [m]
  std::string options{};
  std::string command{};
  std::string date{};
  std::string commit{};
};
using SensitivityResults = std::map<std::string, SensitivityResult>;

/// Results of sensitivity runs in a file, kept by the lines that describe a scene. Where there is no file, nothing is
/// known.
class SensitivityFile {
 public:
  /// \throws scarp::InputError for a file that is none of these
  SensitivityFile(std::filesystem::path path, std::string scene);

  SensitivityResults const& results() const { return results_; }
  /// Its results have this one even where the file does not take it.
  /// \throws scarp::InputError, scarp::FileError
  void add(std::string const& part, SensitivityResult const& result);

 private:
  std::filesystem::path path_;
  std::string scene_;
  SensitivityResults results_;
};

/// The file that comes with the program.
std::filesystem::path default_sensitivity_file();

/// surface_x50, depth: of the run and its ground [m]
scarp::BudgetParts sensitivity_parts(SensitivityResults const& results, double surface_x50, double depth,
                                     scarp::ErrorBounds const& bounds);

/// Where the parts come from, or how to get them; lines.
std::string sensitivity_lines(SensitivityResults const& results);

}  // namespace fault_rupture

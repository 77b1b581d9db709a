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

/// The scene once more with one choice made otherwise, which tells what that choice is worth.
struct Companion {
  std::string part;                 ///< of the error budget
  scarp::RunRecord::Lines options;  ///< those that are other
  Choice choice;
};

/// What is other, as on a command line.
std::string command_options(Companion const& companion);

/// A mesh of as many elements with other directions, unless the mesh comes from a file; load steps of half the size.
/// largest_gradient: that limits the scene's load steps
std::vector<Companion> companions_of(Choice const& choice, double largest_gradient);

/// The same with a limit of its load steps half as large, where that of the others was hardly ever met.
Companion with_smaller_steps(Companion companion);

/// What a companion came to, by its part of the budget.
struct CompanionAnswer {
  double surface_x50 = 0.0;  ///< [m]
  std::string options{};
  std::string command{};
  std::string date{};
  std::string commit{};
};
using CompanionAnswers = std::map<std::string, CompanionAnswer>;

/// Answers of companions in a file, kept by the lines that describe a scene. Where there is no file, nothing is known.
class CompanionFile {
 public:
  /// \throws scarp::InputError for a file that is none of these
  CompanionFile(std::filesystem::path path, std::string scene);

  CompanionAnswers const& answers() const { return answers_; }
  /// \throws scarp::FileError
  void add(std::string const& part, CompanionAnswer answer);

 private:
  std::filesystem::path path_;
  std::string scene_;
  CompanionAnswers answers_;
};

/// The file that comes with the program.
std::filesystem::path usual_companion_file();

/// surface_x50, depth: of the run and its ground [m]
scarp::BudgetParts companion_parts(CompanionAnswers const& answers, double surface_x50, double depth,
                                   scarp::ErrorBounds const& bounds);

/// Where the parts come from, or how to get them; lines.
std::string companion_lines(CompanionAnswers const& answers);

}  // namespace fault_rupture

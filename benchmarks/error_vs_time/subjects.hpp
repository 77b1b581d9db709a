// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scarp/measure/detail/sweep_table.hpp"

namespace error_vs_time {

struct Options {
  std::filesystem::path out = "output/error_vs_time";
  int repetitions = 0;  ///< 0: the subject's own choice
  bool quick = false;   ///< seconds instead of minutes: shorter series, smaller samples

  int repetitions_or(int usual) const { return repetitions > 0 ? repetitions : usual; }
};

/// One sweep of this program. A source of this folder registers what it holds:
/// `bool const registered = register_subject({"column", "what it asks", run});`
struct Subject {
  std::string name;  ///< also of the files: name.csv, name.md, name.png
  std::string question;
  scarp::SweepTable (*run)(Options const&) = nullptr;
  std::vector<double> wanted_errors{0.05, 0.02, 0.01, 0.005};  ///< for which settings are recommended
};

inline std::vector<Subject>& subjects() {
  static std::vector<Subject> all;
  return all;
}

inline bool register_subject(Subject subject) {
  subjects().push_back(std::move(subject));
  return true;
}

}  // namespace error_vs_time

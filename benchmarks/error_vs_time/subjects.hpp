// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <vector>

#include "sweep_table.hpp"

namespace error_vs_time {

struct Options {
  int repetitions = 0;  ///< 0: the subject's own choice
  bool quick = false;   ///< seconds instead of minutes: shorter series, smaller samples

  int repetitions_or(int usual) const { return repetitions > 0 ? repetitions : usual; }
};

/// One sweep of this program. A source of this folder registers its own:
/// `bool const registered = register_subject({"column", "its question", run});`
struct Subject {
  std::string name;  ///< of the data file, error_vs_time_NAME.csv
  std::string question;
  SweepTable (*run)(Options const&) = nullptr;
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

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "scarp/core/status.hpp"

namespace scarp {

/// What one run answered and took. An answer is whatever is compared with a reference: a stress path, a profile at
/// fixed places, a single number. Answers of the same name must have the same length in all runs of a sweep.
struct Measured {
  std::vector<std::pair<std::string, Eigen::VectorXd>> answers{};
  long inner_steps = 0;  ///< of the smallest kind the run knows: DEM steps, else iterations
  Verdict verdict{};
  /// CPU time [s] of what counts, where preparations are to be left out; no number: of the whole run.
  double seconds = std::numeric_limits<double>::quiet_NaN();

  void answer(std::string name, Eigen::VectorXd values) { answers.emplace_back(std::move(name), std::move(values)); }
  void answer(std::string name, double value) { answer(std::move(name), Eigen::VectorXd::Constant(1, value)); }

  bool finite() const {
    for (auto const& [name, values] : answers) {
      if (!values.allFinite()) return false;
    }
    return true;
  }
};

}  // namespace scarp

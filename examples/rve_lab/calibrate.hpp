// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "../shared/run_options.hpp"
#include "../shared/sand/sand.hpp"
#include "mean_curve.hpp"

namespace rve_lab {

struct CalibrateChoice {
  examples::Sand sand{.void_ratio_tolerance = 2e-3};  ///< small packings jump over void ratios
  std::string sand_file{};
  std::string free = "friction,relative-density";
  std::string target{};
  std::vector<std::string> tables{};
  bool triaxial = false;  ///< data of the tables
  std::optional<double> held{};
  std::optional<double> strain{};
  double window = 0.02;
  CurveTest test{};
  int seeds = 4;
  int evaluations = 30;
  int threads = 0;
  bool resume = false;
  examples::Output output{"output/rve_lab"};
};

void declare_calibrate(CLI::App& app, CalibrateChoice& choice);

/// Finds the free parameters of a sand by targets and tables. In the folder: evaluations.csv, calibrated.sand, curve.csv,
/// calibration.csv, sensitivities.csv, summary.json.
/// \throws InputError for targets out of reach, naming what limits them
void calibrate(CalibrateChoice choice, CLI::App const& app);

}  // namespace rve_lab

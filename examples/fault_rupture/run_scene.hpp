// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "any_scene.hpp"
#include "scarp/io/checkpoint_files.hpp"
#include "scarp/run/run_folder.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "sensitivity.hpp"

namespace fault_rupture {

using Moment = std::chrono::steady_clock::time_point;

/// A run about to begin.
struct Start {
  scarp::CheckpointFiles& files;
  scarp::RunFolder* folder = nullptr;  ///< on the root rank
  Moment moment{};                     ///< when the program began
  /// Called once the run itself has ended well; returns the parts of the error budget.
  std::function<SensitivityResults(scarp::RunReport const&)> sensitivity{};
  scarp::ThreadExecutor* threads = nullptr;  ///< that several runs share; without, the run has its own
  std::string name{};                        ///< of one among several, before its lines on the error stream
};

/// Runs a scene, or resumes one, and writes its results.
/// \return exit code of the program
int run(Choice const& choice, Scene const& scene, Start const& begun);

}  // namespace fault_rupture

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "../shared/print.hpp"
#include "../shared/run_options.hpp"
#include "run_scene.hpp"
#include "scarp/io/folder_lock.hpp"
#include "scarp/io/read_file.hpp"
#include "scarp/run/stop_signal.hpp"
#include "sensitivity.hpp"

namespace fault_rupture {

/// Runs the sensitivity runs of a scene's run.
struct SensitivityRuns {
  CLI::App const& app;
  std::filesystem::path folder;  ///< of the scene's run
  std::chrono::steady_clock::time_point started;
  std::string commit{examples::commit()};

  /// Runs those that the file does not have yet of this commit, each in a folder of its own. One that fails is left out
  /// with a warning.
  /// steps: of the scene's run
  void complete(std::vector<SensitivityRun> const& runs, int steps, SensitivityFile& file) const {
    scarp::StopSignal const stop;
    auto const known = file.results();
    for (auto const& run : runs) {
      auto const before = known.find(run.part);
      if (before != known.end() && before->second.commit == commit) continue;
      if (stop.wants_stop()) return;
      try {
        add(run, steps, file);
      } catch (std::exception const& problem) {
        if (stop.wants_stop()) return;
        examples::print(stderr, "warning: the sensitivity run for {} has failed, so that this part is not known: {}\n",
                        run.part, problem.what());
      }
    }
  }

 private:
  void add(SensitivityRun run, int steps, SensitivityFile& file) const {
    auto summary = summary_of(run);
    // Where other things limit the load steps, a limit of their gradient has to be much smaller to have an effect.
    constexpr int max_halvings = 6;
    auto const as_large = [&] { return run.part == "load_step" && summary["steps"].get<int>() < 1.3 * steps; };
    for (int k = 0; k < max_halvings && as_large(); ++k) {
      run = with_smaller_steps(std::move(run));
      summary = summary_of(run);
    }
    if (as_large())
      scarp::reject(
          "its load steps are limited by something else (smaller ones were impossible): give a smaller "
          "--max-displacement-gradient");
    try {
      file.add(run.part, {summary["surface_x50"].get<double>(), command_options(run),
                          "examples/run fault_rupture --sensitivity-runs", scarp::time_stamp().substr(0, 10), commit});
    } catch (std::exception const& problem) {
      examples::print(stderr, "warning: the sensitivity run for {} is not kept for later runs: {}\n", run.part,
                      problem.what());
    }
  }

  /// \return its summary \throws scarp::InputError where it has stopped early
  nlohmann::ordered_json summary_of(SensitivityRun const& varied) const {
    examples::print(stderr, "sensitivity run for {}: {}\n", varied.part, command_options(varied));
    scarp::CheckpointFiles nowhere;
    auto const own = folder / fmt::format("sensitivity_{}", varied.part);
    scarp::RunFolder writes({.folder = own, .overwrite = true}, record_of(varied, own));
    auto const scene = make_scene(varied.choice, 1, true);
    Start const start{nowhere, &writes, started};
    int const code = run(varied.choice, scene, start);
    if (code != 0) scarp::reject("it has stopped early: see {}", (own / "summary.txt").string());
    return nlohmann::ordered_json::parse(scarp::read_file(own / "summary.json"));
  }

  /// With the options that would run it alone.
  scarp::RunRecord record_of(SensitivityRun const& run, std::filesystem::path const& own) const {
    auto record = examples::record_of("fault_rupture, sensitivity run for " + run.part, app);
    std::map<std::string, std::string> others(run.options.begin(), run.options.end());
    others.insert({{"sensitivity-runs", "false"}, {"output", own.string()}});
    for (auto& [name, value] : record.options) {
      if (auto const other = others.find(name); other != others.end()) value = other->second;
    }
    return record;
  }
};

}  // namespace fault_rupture

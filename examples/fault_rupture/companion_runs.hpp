// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "../shared/run_options.hpp"
#include "companions.hpp"
#include "run_scene.hpp"
#include "scarp/io/read_file.hpp"
#include "scarp/io/time_stamp.hpp"

namespace fault_rupture {

/// Runs the companions of a scene's run.
struct CompanionRuns {
  CLI::App const& app;
  std::filesystem::path folder;  ///< of the scene's run
  std::chrono::steady_clock::time_point started;
  std::string commit{examples::commit()};

  /// Runs those that the file does not know yet of this commit, each in a folder of its own. One that is stopped is left out.
  /// steps: of the scene's run
  void complete(std::vector<Companion> const& companions, int steps, CompanionFile& file) const {
    auto const known = file.answers();
    for (auto companion : companions) {
      auto const before = known.find(companion.part);
      if (before != known.end() && before->second.commit == commit) continue;
      auto summary = answer_of(companion);
      // Where other things limit the load steps, a limit of their gradient has to be much smaller to say anything.
      constexpr int most_halvings = 6;
      for (int k = 0; k < most_halvings && companion.part == "load_step" && !summary.empty(); ++k) {
        if (summary["steps"].get<int>() >= 1.3 * steps) break;
        companion = with_smaller_steps(std::move(companion));
        summary = answer_of(companion);
      }
      if (summary.empty()) continue;
      file.add(companion.part,
               {summary["surface_x50"], companion.options, "examples/run fault_rupture --budget-companions",
                scarp::time_stamp().substr(0, 10), commit});
    }
  }

 private:
  /// \return its summary; empty where it has stopped early
  nlohmann::json answer_of(Companion const& companion) const {
    fmt::print(stderr, "companion for {}: {}\n", companion.part, companion.options);
    scarp::CheckpointFiles nowhere;
    auto const own = folder / fmt::format("companion_{}", companion.part);
    scarp::RunFolder writes({.folder = own, .overwrite = true},
                            examples::record_of("fault_rupture, companion for " + companion.part, app));
    auto const scene = make_scene(companion.choice, 1, true);
    Start const start{nowhere, &writes, started};
    int const code = std::visit([&](auto const& one) { return run(companion.choice, one, start); }, scene);
    if (code != 0) {
      fmt::print(stderr, "warning: the companion for {} has stopped early, so that this part is not known\n",
                 companion.part);
      return {};
    }
    return nlohmann::json::parse(scarp::read_file(own / "summary.json"));
  }
};

}  // namespace fault_rupture

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "../shared/run_options.hpp"
#include "../shared/tell.hpp"
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

  /// Runs those that the file does not know yet of this commit, each in a folder of its own. One that fails is left out, and said.
  /// steps: of the scene's run
  void complete(std::vector<Companion> const& companions, int steps, CompanionFile& file) const {
    auto const known = file.answers();
    for (auto const& companion : companions) {
      auto const before = known.find(companion.part);
      if (before != known.end() && before->second.commit == commit) continue;
      if (scarp::StopSignal::wants_stop()) return;
      try {
        ask(companion, steps, file);
      } catch (std::exception const& problem) {
        examples::say(stderr, "warning: the companion for {} has failed, so that this part is not known: {}\n",
                      companion.part, problem.what());
      }
    }
  }

 private:
  void ask(Companion companion, int steps, CompanionFile& file) const {
    auto summary = answer_of(companion);
    // Where other things limit the load steps, a limit of their gradient has to be much smaller to say anything.
    constexpr int most_halvings = 6;
    auto const as_large = [&] { return companion.part == "load_step" && summary["steps"].get<int>() < 1.3 * steps; };
    for (int k = 0; k < most_halvings && as_large(); ++k) {
      companion = with_smaller_steps(std::move(companion));
      summary = answer_of(companion);
    }
    if (as_large())
      scarp::refuse(
          "its load steps are limited by something else (smaller ones were not to be had): say a smaller "
          "--largest-gradient");
    file.add(companion.part,
             {summary["surface_x50"].get<double>(), command_options(companion),
              "examples/run fault_rupture --budget-companions", scarp::time_stamp().substr(0, 10), commit});
  }

  /// \return its summary \throws scarp::InputError where it has stopped early
  nlohmann::json answer_of(Companion const& companion) const {
    examples::say(stderr, "companion for {}: {}\n", companion.part, command_options(companion));
    scarp::CheckpointFiles nowhere;
    auto const own = folder / fmt::format("companion_{}", companion.part);
    scarp::RunFolder writes({.folder = own, .overwrite = true}, record_of(companion, own));
    auto const scene = make_scene(companion.choice, 1, true);
    Start const start{nowhere, &writes, started};
    int const code = std::visit([&](auto const& one) { return run(companion.choice, one, start); }, scene);
    if (code != 0) scarp::refuse("it has stopped early: see {}", (own / "summary.txt").string());
    return nlohmann::json::parse(scarp::read_file(own / "summary.json"));
  }

  /// With the options that would run it alone.
  scarp::RunRecord record_of(Companion const& companion, std::filesystem::path const& own) const {
    auto record = examples::record_of("fault_rupture, companion for " + companion.part, app);
    std::map<std::string, std::string> others(companion.options.begin(), companion.options.end());
    others.insert({{"budget-companions", "false"}, {"output", own.string()}});
    for (auto& [name, value] : record.options) {
      if (auto const other = others.find(name); other != others.end()) value = other->second;
    }
    return record;
  }
};

}  // namespace fault_rupture

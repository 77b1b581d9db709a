// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "../shared/print.hpp"
#include "../shared/run_options.hpp"
#include "ensemble.hpp"
#include "older_results.hpp"
#include "own_folders.hpp"
#include "run_scene.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/read_file.hpp"

namespace fault_rupture {

/// Runs one scene with several packings in one process: the points of all share the threads, and what one does outside
/// of its points runs in parallel to the points of another. Each has the bits of a run of its own.
struct EnsembleRuns {
  CLI::App const& app;
  examples::Output const& output;
  Moment started;

  /// \return exit code of the program: that of the first member that did not come to its end, else 0
  /// \throws scarp::InputError for seeds that are no ensemble, and what a single run throws before it begins
  int run(Choice const& choice, std::vector<std::uint64_t> const& seeds) const {
    require_ensemble(choice, seeds);
    scarp::RunFolder folder({.folder = output.folder,
                             .overwrite = output.overwrite || (choice.resume && is_same_ensemble()),
                             .results = {"ensemble.json", "summary.json"}},
                            examples::record_of("fault_rupture, ensemble", app));
    std::vector<std::unique_ptr<Member>> members;
    for (auto const seed : seeds) members.push_back(std::make_unique<Member>(*this, choice, seed));
    scarp::require_memory(fmt::format("an ensemble of {} runs", seeds.size()),
                          static_cast<double>(seeds.size()) * memory_of(choice, size_of_scene(choice), 1),
                          "name fewer --seeds");
    for (auto& member : members) member->prepare();  // what is rejected here leaves older results alone
    folder.begin();
    remove_older_results(folder.path(), false);
    scarp::ThreadExecutor threads(choice.threads);
    {
      std::vector<std::jthread> runs;
      for (auto& member : members) runs.emplace_back([&] { member->run(threads, started); });
    }
    std::vector<EnsembleMember> ended;
    for (auto& member : members) ended.push_back(member->result);
    return finish(folder, ended);
  }

 private:
  struct Member {
    Choice choice;
    EnsembleMember result;
    OwnFolders own;
    std::optional<Scene> scene{};

    Member(EnsembleRuns const& all, Choice const& shared, std::uint64_t seed)
        : choice(of_seed(shared, seed)),
          result{seed, member_folder(all.output.folder, seed)},
          own(choice, all.app, result.folder, all.output.overwrite, all.record_of(choice, result)) {}

    void prepare() { scene = make_scene(choice, 1, true); }

    void run(scarp::ThreadExecutor& threads, Moment begun) {
      try {
        Start const start{own.files, own.on_root_rank(), begun, {}, &threads, fmt::format("seed {}: ", result.seed)};
        result.code = fault_rupture::run(choice, *scene, start);
      } catch (std::exception const& problem) {
        result.problem = problem.what();
        if (auto* const folder = own.on_root_rank(); folder != nullptr && folder->record().state == "running") {
          try {
            folder->end("failed");
          } catch (std::exception const&) {  // the first problem has more information
          }
        }
      }
    }

    static Choice of_seed(Choice choice, std::uint64_t seed) {
      choice.seed = seed;
      if (!choice.checkpoint.empty()) {
        std::filesystem::create_directories(choice.checkpoint);
        choice.checkpoint = member_folder(choice.checkpoint, seed).string();
      }
      return choice;
    }
  };

  static void require_ensemble(Choice const& choice, std::vector<std::uint64_t> const& seeds) {
    auto sorted = seeds;
    std::ranges::sort(sorted);
    if (seeds.size() < 2)
      scarp::reject("--seeds names one packing (several make an ensemble): use --seed {}", seeds[0]);
    if (auto const twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
      scarp::reject("--seeds names {} twice (the same run counts once): give each seed once", *twice);
    if (choice.soil != Soil::dem)
      scarp::reject("--seeds was given for a soil without packings (all runs would be the same): use --soil dem");
    if (!choice.sensitivity_file.empty())
      scarp::reject("--seeds and --sensitivity-file were given (sensitivity runs belong to one run): leave one out");
    if (choice.sensitivity_runs)
      scarp::reject("--seeds and --sensitivity-runs were given (sensitivity runs belong to one run): leave one out");
    if (ranks() > 1) scarp::reject("--seeds was given on {} ranks (members run on one): leave the ranks out", ranks());
  }

  /// Whether the folder holds an ensemble of the same seeds: its members guard their own folders.
  bool is_same_ensemble() const {
    auto const file = std::filesystem::path(output.folder) / "run.json";
    if (!std::filesystem::exists(file)) return false;
    auto const seeds = [](scarp::RunRecord const& record) {
      auto const found = std::ranges::find(record.options, "seeds", [](auto const& line) { return line.first; });
      return found == record.options.end() ? std::string() : found->second;
    };
    try {
      auto const before = scarp::RunRecord::from(scarp::read_file(file));
      auto const own = examples::record_of("fault_rupture, ensemble", app);
      return before.program == own.program && seeds(before) == seeds(own);
    } catch (scarp::InputError const&) {
      return false;
    }
  }

  /// With the options that would run the member alone.
  scarp::RunRecord record_of(Choice const& choice, EnsembleMember const& member) const {
    auto record = examples::record_of("fault_rupture", app);
    for (auto& [name, value] : record.options) {
      if (name == "seed") value = std::to_string(member.seed);
      if (name == "seeds") value.clear();
      if (name == "output") value = member.folder.string();
      if (name == "checkpoint") value = choice.checkpoint;
    }
    return record;
  }

  int finish(scarp::RunFolder& folder, std::vector<EnsembleMember> const& members) const {
    auto const summary = ensemble_summary(members);
    auto const text = ensemble_table(summary);
    examples::write_json(folder.path() / "ensemble.json", summary);
    scarp::write_file(folder.path() / "ensemble.txt", text);
    write_mean_surface(folder.path() / "surface_mean.csv", members);
    examples::print(stdout, "{}", text);
    auto const stopped = std::ranges::find_if(members, [](auto const& member) { return member.code != 0; });
    folder.end(stopped == members.end() ? "finished" : "stopped early");
    return stopped == members.end() ? 0 : stopped->code;
  }
};

}  // namespace fault_rupture

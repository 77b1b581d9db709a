// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "../shared/command_line.hpp"
#include "../shared/run_options.hpp"
#include "../shared/sand/sand_file.hpp"
#include "any_scene.hpp"
#include "scarp/io/checkpoint_files.hpp"
#include "scarp/io/read_file.hpp"
#include "scarp/run/run_folder.hpp"
#include "team.hpp"

namespace fault_rupture {

/// A line for each choice that the results depend on.
struct ChoiceLines {
  std::map<std::string, std::string> words;  ///< of options
  std::string text{};

  template <class Value>
  void operator()(std::string_view name, Value const& value) {
    if constexpr (std::is_enum_v<Value>) {
      text += fmt::format("{} = {}\n", name, words.at(std::string(name)));
    } else {
      text += fmt::format("{} = {}\n", name, value);
    }
  }
  void operator()(std::string_view name, std::optional<double> const& value) {
    text += fmt::format("{} = {}\n", name, value ? fmt::format("{}", *value) : "the soil's own");
  }
  void operator()(std::string_view name, std::optional<MeshPattern> const& value) {
    text += fmt::format("{} = {}\n", name, value ? words.at(std::string(name)) : "the element's own");
  }
};

/// Of all that the results depend on.
inline ChoiceLines choice_lines(Choice const& choice, CLI::App const& app) {
  auto const options = examples::all_options(app);
  ChoiceLines lines{{options.begin(), options.end()}};
  Choice::members(choice, lines);
  lines("element", element_name);
  // What a file holds and not where it lies.
  if (!choice.sand_file.empty()) lines("sand", std::hash<std::string>{}(examples::text_of(choice.sand)));
  for (auto const& [top, sand] : choice.layers) {
    lines("layer", top);
    lines("sand", std::hash<std::string>{}(examples::text_of(sand)));
  }
  if (!choice.mesh.empty()) {
    lines("mesh", std::hash<std::string>{}(scarp::read_file(choice.mesh)));
    lines("mesh-order", choice.mesh_order);
  }
  return lines;
}

/// All options that the result depends on, without those of output.
/// scene: whose tolerance and limit of the load steps stand where the choice leaves them to the soil
inline std::string scene_lines(Choice choice, CLI::App const& app, Scene const& scene) {
  choice.tolerance = scene.tolerance;
  choice.max_displacement_gradient = scene.stages.stepping.max_displacement_gradient;
  Choice const usual;
  choice.frames = usual.frames;
  choice.probe_a_x = usual.probe_a_x;
  choice.probe_a_y = usual.probe_a_y;
  choice.probe_b_x = usual.probe_b_x;
  choice.probe_b_y = usual.probe_b_y;
  return choice_lines(choice, app).text;
}

/// \throws scarp::CheckpointError
inline scarp::CheckpointFiles checkpoint_files(Choice const& choice, CLI::App const& app) {
  auto lines = choice_lines(choice, app);
  // The error budget follows points of the root rank.
  if (int const count = ranks(); count > 1) lines("ranks", count);
  return {{.folder = choice.checkpoint,
           .resume = choice.resume,
           .every_seconds = choice.checkpoint_every,
           .locks = rank() == 0},
          lines.text};
}

/// What one run has to itself on disk, as long as this lives.
struct OwnFolders {
  scarp::CheckpointFiles files;
  std::optional<scarp::RunFolder> results{};  ///< on the root rank

  /// \throws scarp::InputError for folders that are in use, hold what must be kept or do not fit together
  OwnFolders(Choice const& choice, CLI::App const& app, std::filesystem::path const& folder, bool overwrite,
             scarp::RunRecord record)
      : files(checkpoint_files(choice, app)) {
    if (rank() != 0) return;
    results.emplace(
        scarp::RunFolderSettings{
            .folder = folder, .overwrite = overwrite, .results = {"summary.json", "convergence.csv", "fields.pvd"}},
        std::move(record), &files);
  }

  scarp::RunFolder* on_root_rank() { return results ? &*results : nullptr; }
};

}  // namespace fault_rupture

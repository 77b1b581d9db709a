// SPDX-License-Identifier: BSL-1.0
#include "sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "../shared/data_file.hpp"
#include "../shared/study/chosen_ground.hpp"
#include "../shared/write_json.hpp"
#include "scarp/budget/budget_part.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/read_file.hpp"

namespace fault_rupture {

namespace {

using Json = nlohmann::ordered_json;

/// Triangles with the other diagonals, rectangles of another aspect.
SensitivityRun turned_mesh(Choice choice) {
  double factor = 1.0;  // of the cells' width, for as many elements
  scarp::RunRecord::Lines options;
  if (is_triangle) {
    auto const pattern = choice.pattern.value_or(MeshPattern::crossed);
    bool const crossed = pattern == MeshPattern::crossed || pattern == MeshPattern::jittered;  // crossed too
    choice.pattern = crossed ? MeshPattern::right : MeshPattern::crossed;
    factor = crossed ? 1.0 / std::numbers::sqrt2 : std::numbers::sqrt2;
    options.emplace_back("pattern", crossed ? "right" : "crossed");
  } else {
    double const aspect = choice.aspect > 1.0 ? 1.0 : 1.73;
    factor = std::sqrt(choice.aspect / aspect);
    choice.aspect = aspect;
    options.emplace_back("aspect", fmt::format("{:g}", aspect));
  }
  if (choice.strip_width > 0.0) {
    options.emplace_back("length", fmt::format("{}", choice.length));
    options.emplace_back("size", fmt::format("{}", choice.size));
    options.emplace_back("strip-width", fmt::format("{}", choice.strip_width));
  } else if (choice.elements == 0) {
    auto const size = fmt::format("{:.3g}", factor * choice.size);
    choice.size = std::stod(size);  // as it would be given
    options.emplace_back("size", size);
  }
  return {"mesh", std::move(options), std::move(choice)};
}

/// All that a file holds: scenes with the results of their sensitivity runs.
Json content(std::filesystem::path const& path) {
  if (!std::filesystem::exists(path)) return Json::array();
  auto found = Json::parse(scarp::read_file(path), nullptr, false);
  for (auto& entry : found) {  // written before version 0.2
    if (entry.is_object() && entry.contains("companions")) entry["runs"] = entry["companions"];
    if (entry.is_object()) entry.erase("companions");
  }
  bool sound = found.is_array();
  for (auto const& entry : found) {
    sound = sound && entry.is_object() && entry.contains("runs") &&
            (!entry.contains("scene") || entry["scene"].is_string()) && entry["runs"].is_object();
    if (!sound) break;
    for (auto const& [part, result] : entry["runs"].items())
      sound = sound && result.is_object() && result.contains("surface_x50") && result["surface_x50"].is_number();
  }
  if (!sound)
    scarp::reject("'{}' holds no results of sensitivity runs (a list of scenes is expected): give another file",
                  path.string());
  return found;
}

template <class Entries>
auto* entry_of(Entries& entries, std::string const& scene) {
  auto const found =
      std::ranges::find_if(entries, [&](auto const& entry) { return entry.value("scene", "") == scene; });
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

std::string command_options(SensitivityRun const& run) {
  std::string text;
  for (auto const& [name, value] : run.options) text += fmt::format("{}--{} {}", text.empty() ? "" : " ", name, value);
  return text;
}

std::vector<SensitivityRun> sensitivity_runs_of(Choice const& choice, double max_displacement_gradient) {
  std::vector<SensitivityRun> runs;
  if (choice.mesh.empty()) runs.push_back(turned_mesh(choice));
  SensitivityRun steps{"load_step", {}, choice};
  steps.choice.max_displacement_gradient = max_displacement_gradient;
  runs.push_back(with_smaller_steps(std::move(steps)));
  return runs;
}

SensitivityRun with_smaller_steps(SensitivityRun run) {
  double const gradient = *run.choice.max_displacement_gradient / 2.0;
  run.choice.max_displacement_gradient = gradient;
  run.options = {{"max-displacement-gradient", fmt::format("{:g}", gradient)}};
  return run;
}

SensitivityFile::SensitivityFile(std::filesystem::path path, std::string scene)
    : path_(std::move(path)), scene_(std::move(scene)) {
  auto const all = content(path_);
  auto const* const entry = entry_of(all, scene_);
  if (entry == nullptr) return;
  for (auto const& [part, result] : (*entry)["runs"].items()) {
    results_[part] = {result.value("surface_x50", std::nan("")), result.value("options", ""),
                      result.value("command", ""), result.value("date", ""), result.value("commit", "")};
  }
}

void SensitivityFile::add(std::string const& part, SensitivityResult const& result) {
  results_[part] = result;
  auto all = content(path_);
  auto* entry = entry_of(all, scene_);
  if (entry == nullptr) {
    all.push_back({{"scene", scene_}, {"runs", Json::object()}});
    entry = &all.back();
  }
  (*entry)["runs"][part] = {{"surface_x50", result.surface_x50},
                            {"options", result.options},
                            {"command", result.command},
                            {"date", result.date},
                            {"commit", result.commit}};
  examples::write_json(path_, all);
}

std::filesystem::path default_sensitivity_file() {
  return examples::data_file("fault_rupture/sensitivity.json", FAULT_RUPTURE_SENSITIVITY);
}

scarp::BudgetParts sensitivity_parts(SensitivityResults const& results, double surface_x50, double depth,
                                     scarp::ErrorBounds const& bounds) {
  scarp::BudgetParts parts;
  auto const add = [&](char const* name, double bound, char const* meaning) {
    auto const found = results.find(name);
    if (found == results.end()) return;
    scarp::Sensitivity const change{
        .own = surface_x50, .other = found->second.surface_x50, .size = depth, .bound = bound};
    parts.push_back(change.part(name, meaning));
  };
  add("mesh", bounds.mesh, "surface_x50 on a mesh of other directions, over the depth of the ground");
  add("load_step", bounds.load_step, "surface_x50 with smaller load steps, over the depth of the ground");
  return parts;
}

std::string sensitivity_lines(SensitivityResults const& results) {
  if (results.empty())
    return "What the mesh and the load steps are worth is not known: --sensitivity-runs runs the scene once more for "
           "each\n";
  std::string text;
  for (auto const& [part, result] : results) {
    text += fmt::format("{}: surface_x50 {:.2f} m with {} ({}, commit {}, {})\n", part, result.surface_x50,
                        result.options, result.date, result.commit, result.command);
  }
  return text;
}

}  // namespace fault_rupture

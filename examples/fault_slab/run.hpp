// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>

#include "../shared/print.hpp"
#include "../shared/process_usage.hpp"
#include "../shared/renamed_keys.hpp"
#include "../shared/run_options.hpp"
#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/observe/convergence_log.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/observe/progress.hpp"
#include "scarp/run/checkpointed_run.hpp"
#include "scarp/run/stop_signal.hpp"
#include "scarp/run/time_limit.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "sections.hpp"

namespace fault_slab {

using Moment = scarp::TimeLimit::Moment;

inline nlohmann::ordered_json json_of(Section const& section) {
  auto const& measures = section.measures;
  double settled = 0.0;
  for (auto const& point : section.profile) settled = std::max(settled, point.settlement);
  return {{"y", section.y},
          {"share_of_throw", section.share},
          {"x05", measures.surface_x05},
          {"x50", measures.surface_x50},
          {"x95", measures.surface_x95},
          {"width", measures.surface_x95 - measures.surface_x05},
          {"outcrop_width", measures.outcrop_width},
          {"slope_max", measures.surface_slope_max},
          {"settlement_max", settled}};
}

/// Places and widths along the strike [m], and what the run took.
template <class Problem>
nlohmann::ordered_json summary(Choice const& choice, Scene const& scene, Problem const& problem,
                               std::vector<Section> const& all, scarp::RunReport const& run,
                               examples::RunUsage const& used) {
  auto const& grid = problem.discretisation();
  nlohmann::ordered_json json;
  json["status"] = run.verdict.acceptable() ? "ok" : std::string(name(run.verdict.reason));
  json["elements"] = grid.mesh().elements.size();
  json["elements_across"] = choice.across;
  json["element_size"] = scene.ground.layer.size;
  json["points"] = grid.point_count();
  json["nodes"] = grid.mesh().nodes.size();
  json["throw_over_depth"] = run.load / scene.ground.layer.depth;
  json["near"] = json_of(all.front());
  json["middle"] = json_of(all[all.size() / 2]);
  json["far"] = json_of(all.back());
  for (auto const& section : all) json["sections"].push_back(json_of(section));
  json["max_accepted_residual"] = run.largest_residual;
  json["steps"] = run.steps;
  json["rejected_steps"] = run.refused;
  json["last_rejection"] = std::string(name(run.last_failure));
  json["iterations"] = run.iterations;
  json["dem_steps"] = run.inner_steps;
  json["share_of_time_in_points"] = run.seconds > 0.0 ? run.material_seconds / run.seconds : 0.0;
  json["cpu_seconds"] = used.cpu_seconds();
  json["peak_memory_bytes"] = used.peak_memory_bytes();
  examples::add_keys_from_before(json);
  return json;
}

inline void write_surface(std::vector<Section> const& all, std::filesystem::path const& file) {
  scarp::CsvTable table({"x", "y", "settlement"});
  for (auto const& section : all) {
    for (auto const& point : section.profile) table.add(point.x_initial, section.y, point.settlement);
  }
  table.write(file);
}

inline void print_table(std::vector<Section> const& all) {
  examples::print(stdout, "{:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>10}\n", "y [m]", "throw", "x05 [m]", "x50 [m]",
                  "x95 [m]", "width", "settlement");
  for (auto const& section : all) {
    auto const json = json_of(section);
    auto const& at = section.measures;
    examples::print(stdout, "{:8.2f} {:8.3f} {:8.2f} {:8.2f} {:8.2f} {:8.2f} {:10.3f}\n", section.y, section.share,
                    at.surface_x05, at.surface_x50, at.surface_x95, at.surface_x95 - at.surface_x05,
                    json["settlement_max"].get<double>());
  }
}

/// Fields of an older run would be mixed up with the new ones.
inline void begin_anew(std::filesystem::path const& folder) {
  std::filesystem::remove(folder / "summary.json");
  scarp::make_folder(folder / "fields");
  for (auto const& file : std::filesystem::directory_iterator(folder / "fields")) {
    if (file.path().extension() == ".vtu") std::filesystem::remove(file.path());
  }
}

/// Totals of earlier processes in a resumed run.
struct RunNotes {
  scarp::GroundAtRest<3> rest{};
  examples::RunUsage used;

  SCARP_MEMBERS(rest, used)
};

/// Runs a scene, or resumes one, and writes its results.
/// \return exit code of the program: 0, 130 where it was interrupted, 3 where it stopped for another reason
inline int run(Choice const& choice, scarp::RunFolder& folder, scarp::CheckpointFiles& files, Moment started) {
  auto const scene = make_scene(choice);
  scarp::ThreadExecutor executor(choice.threads);
  auto problem = scene.problem(executor);
  examples::print(stderr, "{} hexahedra, {} points, {} threads\n", problem.discretisation().mesh().elements.size(),
                  problem.discretisation().point_count(), executor.threads());
  folder.begin();
  bool const resumes = files.resumes();
  if (!resumes) begin_anew(folder.path());
  double const depth = scene.ground.layer.depth;
  scarp::LoadMeasure const measure{depth, "throw_over_depth"};
  auto const start = resumes ? scarp::CsvStart::resumed : scarp::CsvStart::anew;
  scarp::Observers observers(
      scarp::FieldSeries(folder.path(), {.to = scene.throw_to, .count = choice.frames, .unit = depth}),
      scarp::ConvergenceLog(folder.path() / "convergence.csv", measure, start),
      scarp::Progress(scene.throw_to, measure), scarp::StopSignal(), scarp::TimeLimit(choice.time_limit, started));
  RunNotes notes{.used = examples::RunUsage(started)};
  auto& rest = notes.rest;
  scarp::CheckpointedRun stages(files, observers, notes);
  stages.stage([&] {
    auto const settled = scene.settle(problem, stages);
    rest = scarp::ground_at_rest(problem);
    return settled;
  });
  stages.stage([&] { return scene.rupture(problem, stages); });
  auto const& report = stages.report();
  if (stages.stopped()) {
    folder.end(stages.trouble());
    examples::print(stderr, "fault_slab: {}\n", stages.trouble());
  } else if (!report.verdict.acceptable()) {
    observers.ended(problem, report.load);
  }
  auto const& grid = problem.discretisation();
  auto const all = sections(scene, grid.mesh(), rest.of(grid.nodes()), grid.positions(), report.load);
  write_surface(all, folder.path() / "surface.csv");
  auto json = summary(choice, scene, problem, all, report, notes.used);
  json["run"] = examples::json_of(folder.record());
  examples::write_json(folder.path() / "summary.json", json);
  if (stages.stopped()) return 1;
  folder.end(report.verdict.acceptable() ? "finished" : std::string(name(report.verdict.reason)));
  print_table(all);
  if (report.verdict.acceptable()) return 0;
  examples::print(stderr, "fault_slab: stopped at h/H = {:.5f} ({}; last rejected step: {})\n", report.load / depth,
                  name(report.verdict.reason), name(report.last_failure));
  return report.verdict.reason == scarp::Reason::interrupted ? 130 : 3;
}

}  // namespace fault_slab

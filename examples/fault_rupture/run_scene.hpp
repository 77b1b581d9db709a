// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>
#include <filesystem>

#include "scarp/io/packing_tables.hpp"
#include "scarp/scene/convergence_log.hpp"
#include "scarp/scene/field_series.hpp"
#include "scarp/scene/probe.hpp"
#include "scarp/scene/progress.hpp"
#include "scarp/scene/stop_signal.hpp"
#include "scarp/scene/surface_log.hpp"
#include "scarp/scene/time_limit.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "summary.hpp"

namespace fault_rupture {

/// An older, longer series would be mixed up with the new one, and an old summary would speak for it.
inline void remove_older_results(std::filesystem::path const& folder) {
  for (auto const* name : {"fields.pvd", "summary.json", "summary.txt", "footing.csv", "footing_base.csv",
                           "packing_grains.csv", "packing_contacts.csv"})
    std::filesystem::remove(folder / name);
  for (auto const& file : std::filesystem::directory_iterator(folder / "fields")) {
    std::string const name = file.path().filename().string();
    if (name.starts_with("step_") && name.ends_with(".vtu")) std::filesystem::remove(file.path());
  }
}

/// An observer that has nothing to see.
struct NoFooting : scarp::NeverStops {
  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const&) {}
};

inline NoFooting footing_log(std::filesystem::path const&, scarp::BareGround const&, double, int, double) { return {}; }
template <class Structure>
scarp::FootingLog<Structure> footing_log(std::filesystem::path const& folder, Structure const& structure, double to,
                                         int profiles, double load_unit) {
  return {folder, structure, to, profiles, load_unit};
}

/// Runs a scene and writes its results.
/// \return exit code of the program
template <class SceneType>
int run(Choice const& choice, SceneType const& scene, std::chrono::steady_clock::time_point started) {
  namespace fs = std::filesystem;
  auto const elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  };
  scarp::ThreadExecutor executor(choice.threads);
  auto problem = scene.problem(executor);
  fmt::print(stderr, "{} triangles, {} threads, ground made after {:.1f} s\n",
             problem.discretisation().mesh().elements.size(), executor.threads(), elapsed());

  fs::path const folder = choice.output;
  fs::create_directories(folder / "fields");
  remove_older_results(folder);
  if constexpr (requires { scene.soil.source.packings; }) {
    auto const& packings = scene.soil.source.packings;
    scarp::write_packing_tables(folder, packings[packings.size() / 2], scene.soil.law);
  }
  double const depth = scene.layer.depth;
  double const to = scene.throw_to;
  constexpr int profiles = 17;
  auto const& grid = problem.discretisation();
  auto const at = [&](double x, double y) { return nearest_point(grid, scarp::Vector<2>(x, y)); };
  scarp::Observers observers(
      scarp::FieldSeries<scarp::RveQuantities>(folder, to, choice.frames, depth),
      scarp::SurfaceLog(folder / "surface.csv", scarp::boundary_nodes(grid.mesh(), "surface"), to, profiles, depth),
      scarp::RveProbe(folder / "probe_A.csv", at(choice.probe_a_x, choice.probe_a_y), depth),
      scarp::RveProbe(folder / "probe_B.csv", at(choice.probe_b_x, choice.probe_b_y), depth),
      footing_log(folder, scene.structure, to, profiles, depth),
      scarp::ConvergenceLog(folder / "convergence.csv", depth), scarp::Progress(to, depth), scarp::StopSignal(),
      scarp::TimeLimit(choice.time_limit));

  auto report = scene.settle(problem, observers);
  auto const rest = at_rest(problem, scene);
  if (report.verdict.acceptable()) report = scarp::joined(report, scene.place(problem, observers));
  if (report.verdict.acceptable()) report = scarp::joined(report, scene.rupture(problem, observers));

  auto const json = summary(choice, scene, problem, rest, report, elapsed());
  scarp::write_file(folder / "summary.json", json.dump(2) + "\n");
  std::string text = table(json);
  if (!report.verdict.acceptable()) {
    text =
        fmt::format("INCOMPLETE: stopped at h/H = {:.5f} ({}; last refused step: {}, point {})\n", report.load / depth,
                    name(report.verdict.reason), name(report.last_failure), report.worst_point) +
        text;
  }
  scarp::write_file(folder / "summary.txt", text);
  fmt::print("{}", text);
  if (report.verdict.acceptable()) return 0;
  constexpr int interrupted = 130;  // as a shell reports Ctrl-C
  return report.verdict.reason == scarp::Reason::interrupted ? interrupted : 3;
}

// Each soil's scenes are compiled in a source of their own.
extern template int run(Choice const&, SandFreeField const&, std::chrono::steady_clock::time_point);
extern template int run(Choice const&, SandStickingFooting const&, std::chrono::steady_clock::time_point);
extern template int run(Choice const&, SandFrictionalFooting const&, std::chrono::steady_clock::time_point);
extern template int run(Choice const&, MohrCoulombFreeField const&, std::chrono::steady_clock::time_point);
extern template int run(Choice const&, MohrCoulombStickingFooting const&, std::chrono::steady_clock::time_point);
extern template int run(Choice const&, MohrCoulombFrictionalFooting const&, std::chrono::steady_clock::time_point);
extern template int run(Choice const&, ElasticFreeField const&, std::chrono::steady_clock::time_point);
extern template int run(Choice const&, ElasticStickingFooting const&, std::chrono::steady_clock::time_point);
extern template int run(Choice const&, ElasticFrictionalFooting const&, std::chrono::steady_clock::time_point);

}  // namespace fault_rupture

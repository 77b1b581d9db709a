// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "constitutive/nestings.hpp"
#include "scarp/budget/error_budget.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/fault/surface_log.hpp"
#include "scarp/observe/convergence_log.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/observe/packing_series.hpp"
#include "scarp/observe/probe.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/run/checkpointed_run.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/crossed_rectangle.hpp"
#include "support/files.hpp"

/// A block whose top is pulled until it is fluid, seen by all observers that remember something, on one process or
/// several.
namespace watched {

using Problem = scarp::EquilibriumProblem<scarp::Discretisation<scarp::Tri3, scarp::SmallStrain>>;

template <class Provider>
Problem block(Provider const& provider, scarp::Executor& executor) {
  auto mesh = samples::CrossedRectangle{.columns = 2, .rows = 2}.generate();
  mesh.boundaries["surface"] = mesh.boundaries.at("top");
  scarp::Discretisation<scarp::Tri3, scarp::SmallStrain> grid(std::move(mesh));
  scarp::Constraints constraints(grid.mesh());
  for (int const node : scarp::boundary_nodes(grid.mesh(), "bottom")) constraints.fix(node);
  for (int const node : scarp::boundary_nodes(grid.mesh(), "top")) constraints.move(node, 1, 1.0);
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  scarp::MaterialPoints<2> points(provider, sites, {}, [&](int point) { return executor.owns(point); });
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(grid.dof_count());
  return {std::move(grid), std::move(points), std::move(constraints), std::move(loads), executor};
}

struct Stop {
  int attempts;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const&) {
    --attempts;
  }
  bool wants_stop() const { return attempts <= 0; }

  SCARP_MEMBERS_EXCEPT((attempts))
};

struct NoNotes {
  template <class Self, class Visit>
  static void members(Self&, Visit&&) {}
};

struct Pull {
  double to = 4e-3;  ///< [m]
  double tolerance = 1e-5;
};

/// What the first process has seen in the end.
struct Outcome {
  scarp::RunReport report{};
  std::string states{};  ///< bits of all points
  std::vector<double> budget{};
  std::map<std::string, std::string> files{};  ///< contents, without wall times
};

inline std::string without_times(std::filesystem::path const& file) {
  std::string const text = samples::content(file);
  if (file.extension() == ".jsonl") return std::to_string(std::count(text.begin(), text.end(), '\n')) + " lines";
  if (file.filename() != "convergence.csv") return text;
  std::string kept;
  std::vector<std::string> names;
  std::size_t at = 0;
  while (at < text.size()) {
    std::size_t const end = std::min(text.find('\n', at), text.size());
    std::string const line = text.substr(at, end - at);
    std::vector<std::string> cells{""};
    for (char const letter : line) letter == ',' ? void(cells.emplace_back()) : cells.back().push_back(letter);
    if (at == 0) names = cells;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (!names.at(k).starts_with("seconds")) kept += cells[k] + ',';
    }
    kept += '\n';
    at = end + 1;
  }
  return kept;
}

template <class Provider>
Outcome pull(Provider const& provider, scarp::Executor& executor, std::filesystem::path const& folder,
             Pull const& wanted, scarp::CheckpointFiles files = {}, int attempts = 1000) {
  double const to = wanted.to;
  auto problem = block(provider, executor);
  Outcome outcome;
  auto const start = files.resumes() ? scarp::CsvStart::resumed : scarp::CsvStart::anew;
  scarp::ErrorBudget budget(problem, scarp::ErrorBounds{}, scarp::ErrorSampling{.points_per_tracked = 3});
  std::filesystem::create_directories(folder / "fields");
  scarp::OnRootRank observers(executor, [&] {
    return scarp::Observers(
        scarp::FieldSeries(folder, {.to = to, .count = 3}), scarp::RveProbe(folder / "probe.csv", 1, {}, start),
        scarp::PackingSeries(folder, "probe", 1, to, {0.0, 0.5, 1.0}, {}),
        scarp::ConvergenceLog(folder / "convergence.csv", {}, start),
        scarp::SurfaceLog<>(folder / "surface.csv", to, 3, 1.0, start), std::ref(budget), Stop{attempts});
  });
  NoNotes notes;
  scarp::CheckpointedRun run(files, observers, notes);
  scarp::QuasiNewton<> const solver{.tolerance = wanted.tolerance};
  scarp::LoadStepping const stepping{
      .first = to / 8.0, .smallest = to / 1e4, .largest = to / 4.0, .max_displacement_gradient = 0.1};
  run.stage([&] { return stepping.settle(solver, problem, 0.0, run); });
  run.stage([&] { return stepping.run(solver, problem, 0.0, to, run); });
  outcome.report = run.report();
  if (outcome.report.verdict.reason == scarp::Reason::interrupted) return outcome;
  observers.ended(problem, outcome.report.load);
  scarp::on_root_rank(problem, [&] {
    scarp::StateWriter positions;
    positions("positions", problem.discretisation().positions());
    outcome.states = positions.bits();
    for (int point = 0; point < problem.points().size(); ++point) {
      scarp::visit_point(problem, point, [&](auto const& points, int k) {
        scarp::StateWriter writer;
        writer("stress", points.committed_stress(k));
        writer("tangent", points.committed_tangent(k));
        outcome.states += points.pack(k) + writer.bits();
      });
    }
    for (auto const& part : budget.parts()) outcome.budget.push_back(part.value);
    for (auto const& file : std::filesystem::recursive_directory_iterator(folder)) {
      if (file.is_regular_file() && file.path().parent_path().filename() != "states")
        outcome.files[std::filesystem::relative(file.path(), folder).string()] = without_times(file.path());
    }
  });
  return outcome;
}

/// The same in parts, each by new objects that go on from a checkpoint, one attempt long.
template <class Provider>
Outcome pull_in_parts(Provider const& provider, scarp::Executor& executor, std::filesystem::path const& folder,
                      Pull const& wanted) {
  scarp::CheckpointSettings const settings{
      .folder = folder / "states", .resume = true, .every_seconds = 1e9, .locks = scarp::is_root_rank(executor)};
  for (int parts = 0; parts < 100; ++parts) {
    auto outcome = pull(provider, executor, folder, wanted, {settings, "a block\n"}, 1);
    if (outcome.report.verdict.reason != scarp::Reason::interrupted) return outcome;
  }
  return {};
}

/// visit(name, provider, pull) for every nesting.
template <class Visit>
void for_each_case(Visit const& visit) {
  nestings::for_each(
      [&](std::string const& name, auto const& provider) { visit(name, scarp::AnyProvider<2>(provider), Pull{}); });
}

}  // namespace watched

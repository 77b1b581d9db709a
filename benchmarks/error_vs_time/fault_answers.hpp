// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cpu_time_limit.hpp"
#include "scarp/fault/fault_scene.hpp"
#include "scarp/measure/measured.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/observe/ground_at_rest.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/observe/rupture_survey.hpp"

namespace error_vs_time {

/// Settlement over throw at fixed places of the initial surface, between the sides, which are prescribed.
inline Eigen::VectorXd settlements(std::vector<scarp::SurfacePoint> const& profile, double fault_throw) {
  constexpr int places = 29;
  double const left = profile.front().x_initial;
  double const right = profile.back().x_initial;
  Eigen::VectorXd found(places);
  for (int k = 0; k < places; ++k) {
    double const x = left + (right - left) * (k + 1) / (places + 1);
    found(k) = scarp::settlement_at(profile, x) / fault_throw;
  }
  return found;
}

/// Forces [N] that hold the ground, along x and y: left side, foot wall, hanging wall, right side.
template <class Problem>
Eigen::VectorXd held_forces(Problem& problem, double tip) {
  auto const& mesh = problem.discretisation().mesh();
  Eigen::VectorXd const unbalanced = problem.evaluate_committed().unbalanced;
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(8);
  std::vector<bool> counted(mesh.nodes.size(), false);
  auto const add = [&](int node, int part) {
    auto const n = static_cast<std::size_t>(node);
    if (!counted[n]) sums.segment<2>(2 * part) += unbalanced.segment<2>(2 * node);
    counted[n] = true;
  };
  for (int const node : boundary_nodes(mesh, "left")) add(node, 0);
  for (int const node : boundary_nodes(mesh, "right")) add(node, 3);
  for (int const node : boundary_nodes(mesh, "bottom"))
    add(node, mesh.nodes[static_cast<std::size_t>(node)].x() > tip * (1.0 + 1e-12) + 1e-9 ? 2 : 1);
  return sums;
}

/// What a fault scene answers at the end of its run, and what the run took.
/// most_seconds: of the processor, after which the run ends as `interrupted`
template <class SceneType, class Executor>
scarp::Measured run_fault(SceneType const& scene, Executor& executor, double most_seconds) {
  auto problem = scene.problem(executor);
  CpuTimeLimit limit(most_seconds);
  scarp::CpuTime const time;
  auto report = scene.settle(problem, limit);
  if (report.verdict.acceptable()) report = scarp::joined(report, scene.place(problem, limit));
  auto const rest = scarp::ground_at_rest(problem);
  if (report.verdict.acceptable()) report = scarp::joined(report, scene.rupture(problem, limit));
  scarp::Measured measured;
  measured.seconds = time.seconds();
  measured.inner_steps = report.inner_steps;
  measured.verdict = report.verdict;
  if (!report.verdict.acceptable()) return measured;
  auto const& grid = problem.discretisation();
  auto const& mesh = grid.mesh();
  auto const profile = scarp::surface_profile(mesh, rest.of(mesh), grid.positions());
  auto const survey = scarp::rupture_survey(mesh, rest.of(mesh), grid.positions(), offset_at(scene.fault, report.load));
  measured.answer("surface profile", settlements(profile, report.load));
  measured.answer("outcrop", survey.surface.outcrop_x);
  measured.answer("x05", survey.surface.surface_x05);
  measured.answer("x50", survey.surface.surface_x50);
  measured.answer("x95", survey.surface.surface_x95);
  measured.answer("band width", survey.surface.outcrop_width);
  measured.answer("reactions", held_forces(problem, scene.fault.tip));
  if constexpr (requires { scene.structure.motion(problem); }) {
    auto const motion = scene.structure.motion(problem);
    measured.answer("tilt", motion.tilt);
    measured.answer("footing settlement", motion.settlement);
  }
  return measured;
}

}  // namespace error_vs_time

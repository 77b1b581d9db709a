// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "any_tangent.hpp"
#include "scarp/measure/cpu_time.hpp"
#include "scarp/observe/ground_at_rest.hpp"
#include "scarp/observe/outcrop.hpp"
#include "scarp/run/time_limit.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace fault_benchmarks {

/// A solver and what of the scene goes with it.
template <class SolverType>
struct Setting {
  using Solver = SolverType;
  std::string name;
  AnyTangent tangent{scarp::ElasticContactTangent{}};
  int least_steps = 20;
  int few = 6;
  int many = 10;
  int most_iterations = 30;
  double largest_gradient = 0.01;  ///< of a load step
  double residual = 1.0;           ///< over the one that is asked of all settings
};

/// Where a run ended and what it took.
struct End {
  std::vector<scarp::SurfacePoint> surface;
  Eigen::VectorXd reactions;
  scarp::RunReport report;
  double cpu_seconds = 0.0;
};

/// Largest difference of settlements.
inline double surface_difference(End const& a, End const& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.surface.size(); ++k) {
    largest = std::max(largest, std::abs(a.surface[k].settlement - b.surface[k].settlement));
  }
  return largest;
}

/// The free field of 220 triangles; optional arguments of a program: throw over depth (0.03), grains (100).
inline fault_rupture::Choice small_free_field(int argc, char** argv) {
  fault_rupture::Choice choice;
  choice.size = 5.0;
  choice.throw_over_depth = argc > 1 ? std::atof(argv[1]) : 0.03;
  choice.grains = argc > 2 ? std::atoi(argv[2]) : 100;
  return choice;
}

/// One thread, at most `seconds` of wall time.
template <class SettingType>
End run(SettingType const& setting, fault_rupture::SandFreeField const& study, double tolerance, double seconds) {
  typename SettingType::Solver solver;
  solver.tolerance = tolerance * setting.residual;
  solver.most_iterations = setting.most_iterations;
  auto scene = scene_of(study, setting.tangent, solver);
  scene.soil.least_steps = setting.least_steps;
  scene.stepping.few = setting.few;
  scene.stepping.many = setting.many;
  scene.stepping.largest_gradient = setting.largest_gradient;
  scarp::ThreadExecutor executor(1);
  auto problem = scene.problem(executor);
  scarp::TimeLimit limit(seconds);
  scarp::CpuTime const time;
  auto const settled = scene.settle(problem, limit);
  auto const rest = scarp::ground_at_rest(problem);
  End end;
  end.report = scarp::joined(settled, scene.rupture(problem, limit));
  end.cpu_seconds = time.seconds();
  auto const& grid = problem.discretisation();
  end.surface = scarp::surface_profile(grid.mesh(), rest.of(grid.mesh()), grid.positions());
  Eigen::VectorXd const forces = problem.evaluate_committed().unbalanced;
  end.reactions = forces(problem.constraints().prescribed_dofs());
  return end;
}

}  // namespace fault_benchmarks

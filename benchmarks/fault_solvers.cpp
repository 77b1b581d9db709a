// SPDX-License-Identifier: BSL-1.0
// Which solver brings the fault scene into balance at the least cost? The quick free-field scene (220 triangles) under every
// setting of a list, against the first one at a fifth of the residual; prints the table of docs/solvers.md.
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <string>
#include <tuple>
#include <vector>

#include "any_tangent.hpp"
#include "scarp/homogenise/condensed_tangent.hpp"
#include "scarp/scene/outcrop.hpp"
#include "scarp/scene/time_limit.hpp"
#include "scarp/solver/anderson_mixing.hpp"
#include "scarp/solver/bfgs_mixing.hpp"
#include "scarp/solver/dynamic_relaxation.hpp"
#include "scarp/solver/frozen_tangent.hpp"
#include "scarp/solver/line_search.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace {

using fault_benchmarks::AnyTangent;
using scarp::AlongIterates;
using scarp::AndersonMixing;
using scarp::BfgsMixing;
using scarp::ConsistentTangent;
using scarp::DynamicRelaxation;
using scarp::FrozenTangent;
using scarp::LineSearch;
using scarp::PlainStep;
using scarp::PointSecant;
using scarp::QuasiNewton;
using scarp::SparseLu;

template <class SolverType>
struct Setting {
  using Solver = SolverType;
  std::string name;
  AnyTangent tangent{scarp::ElasticContactTangent{}};
  int least_steps = 20;
  int few = 6;
  int many = 10;
  int most_iterations = 30;
};

/// Where a run ended, for comparison with others.
struct End {
  std::vector<scarp::SurfacePoint> surface;
  Eigen::VectorXd reactions;
};

/// Largest difference of settlements.
double surface_difference(End const& a, End const& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.surface.size(); ++k) {
    largest = std::max(largest, std::abs(a.surface[k].settlement - b.surface[k].settlement));
  }
  return largest;
}

template <class SettingType>
End run(SettingType const& setting, fault_rupture::SandFreeField const& study, double tolerance, double seconds,
        End const* reference) {
  typename SettingType::Solver solver;
  solver.tolerance = tolerance;
  solver.most_iterations = setting.most_iterations;
  auto scene = fault_benchmarks::scene_of(study, setting.tangent, solver);
  scene.soil.least_steps = setting.least_steps;
  scene.stepping.few = setting.few;
  scene.stepping.many = setting.many;
  scarp::ThreadExecutor executor(1);
  auto problem = scene.problem(executor);
  scarp::TimeLimit limit(seconds);
  std::clock_t const started = std::clock();
  auto const settled = scene.settle(problem, limit);
  auto const report = scarp::joined(settled, scene.rupture(problem, limit));
  double const cpu = static_cast<double>(std::clock() - started) / CLOCKS_PER_SEC;
  auto const& grid = problem.discretisation();
  End end{scarp::surface_profile(grid.mesh(), grid.positions(), scarp::boundary_nodes(grid.mesh(), "surface")), {}};
  Eigen::VectorXd const forces = problem.evaluate_committed().unbalanced;
  auto const held = problem.constraints().prescribed_dofs();
  end.reactions = forces(held);
  std::string differences = "| |";
  if (reference != nullptr && report.load == scene.throw_to) {
    differences = fmt::format("{:.2f} | {:.2f} |", 100.0 * surface_difference(end, *reference) / scene.throw_to,
                              100.0 * (end.reactions - reference->reactions).norm() / reference->reactions.norm());
  }
  fmt::print("| {} | {:.4f} | {:.1e} | {} | {} | {} | {:.2f} | {:.1f} | {}\n", setting.name,
             report.load / scene.layer.depth, report.largest_residual, report.steps, report.refused, report.iterations,
             static_cast<double>(report.inner_steps) / 1e6, cpu, differences);
  std::fflush(stdout);
  return end;
}

}  // namespace

/// Optional arguments: throw over depth (0.03), grains (100), residual (1e-3), wall time of each run [s] (120).
int main(int argc, char** argv) {
  auto const argument = [&](int k, double otherwise) { return argc > k ? std::atof(argv[k]) : otherwise; };
  fault_rupture::Choice choice;
  choice.size = 5.0;
  choice.throw_over_depth = argument(1, 0.03);
  choice.grains = static_cast<int>(argument(2, 100.0));
  double const tolerance = argument(3, 1e-3);
  double const seconds = argument(4, 120.0);
  auto const study = fault_rupture::make<fault_rupture::SandFreeField>(choice);
  AnyTangent const condensed{scarp::CondensedTangent{}};
  Setting<QuasiNewton<PointSecant>> const first{"point secant"};
  auto const settings = std::make_tuple(
      first, Setting<QuasiNewton<PointSecant>>{"point secant from condensed tangents", condensed},
      Setting<QuasiNewton<PointSecant, AndersonMixing>>{"point secant, Anderson"},
      Setting<QuasiNewton<PointSecant, LineSearch<>>>{"point secant, line search"},
      Setting<QuasiNewton<PointSecant, PlainStep, SparseLu, AlongIterates>>{
          .name = "point secant along iterates", .few = 12, .many = 20, .most_iterations = 60},
      Setting<QuasiNewton<FrozenTangent, AndersonMixing>>{"frozen eq. 6, Anderson"},
      Setting<QuasiNewton<FrozenTangent, AndersonMixing>>{"frozen condensed, Anderson", condensed},
      Setting<QuasiNewton<FrozenTangent, BfgsMixing>>{"frozen eq. 6, BFGS"},
      Setting<QuasiNewton<FrozenTangent, BfgsMixing>>{"frozen condensed, BFGS", condensed},
      Setting<QuasiNewton<ConsistentTangent>>{"Newton, eq. 6"},
      Setting<QuasiNewton<ConsistentTangent>>{"Newton, condensed", condensed},
      Setting<DynamicRelaxation<>>{
          .name = "dynamic relaxation", .least_steps = 4, .few = 150, .many = 300, .most_iterations = 1000});
  fmt::print(
      "| solver | h/H | largest residual | steps | refused | iterations | million DEM steps | CPU s | surface, % of "
      "throw | reactions, % |\n|---|---|---|---|---|---|---|---|---|---|\n");
  Setting<QuasiNewton<PointSecant>> tight = first;
  tight.name = "point secant, a fifth of the residual";
  tight.most_iterations = 60;
  End const reference = run(tight, study, tolerance / 5.0, 4.0 * seconds, nullptr);
  std::apply([&](auto const&... setting) { (run(setting, study, tolerance, seconds, &reference), ...); }, settings);
}

// SPDX-License-Identifier: BSL-1.0
// How many macro iterations does each tangent policy save? The quick free-field scene (220 triangles, 100 grains) to
// h/H = 0.03 under the frozen tangent with Anderson mixing and under the point secant; prints a table of
// docs/tangents.md.
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "any_tangent.hpp"
#include "scarp/homogenise/condensed_tangent.hpp"
#include "scarp/homogenise/sliding_aware_tangent.hpp"
#include "scarp/measure/cpu_time.hpp"
#include "scarp/solver/anderson_mixing.hpp"
#include "scarp/solver/frozen_tangent.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace {

using fault_benchmarks::AnyTangent;

struct Candidate {
  std::string name;
  AnyTangent tangent;
};

double throw_over_depth = 0.03;

template <class Rule, class Mixing>
void run(std::string const& solver, Candidate const& candidate, fault_rupture::SandFreeField const& study) {
  scarp::QuasiNewton<Rule, Mixing> settings;
  settings.tolerance = study.solver.tolerance;
  settings.most_iterations = study.solver.most_iterations;
  auto const scene = fault_benchmarks::scene_of(study, candidate.tangent, settings);
  scarp::ThreadExecutor executor(0);
  auto problem = scene.problem(executor);
  scarp::NoObserver observer;
  scarp::CpuTime const time;
  auto const settled = scene.settle(problem, observer);
  auto const report = scarp::joined(settled, scene.rupture(problem, observer));
  double const cpu = time.seconds();
  fmt::print("| {} | {} | {:.4f} | {} | {} | {} | {:.2f} | {:.1f} |\n", solver, candidate.name,
             report.load / scene.ground.layer.depth, report.steps, report.refused, report.iterations,
             static_cast<double>(report.inner_steps) / 1e6, cpu);
  std::fflush(stdout);
}

}  // namespace

/// One optional argument: the throw over the depth, 0.03 without.
int main(int argc, char** argv) {
  using scarp::CondensedTangent;
  using scarp::ElasticContactTangent;
  using scarp::SlidingAwareTangent;
  if (argc > 1) throw_over_depth = std::atof(argv[1]);
  fault_rupture::Choice choice;
  choice.size = 5.0;
  choice.grains = 100;
  choice.throw_over_depth = throw_over_depth;
  auto const study = fault_rupture::make<fault_rupture::SandFreeField>(choice);
  std::vector<Candidate> const candidates{
      {"eq. 6", {ElasticContactTangent{}}},
      {"sliding-aware, share 0", {SlidingAwareTangent{}}},
      {"condensed, share 1", {CondensedTangent{.sliding = {.shear_share = 1.0}}}},
      {"condensed, share 0.5", {CondensedTangent{.sliding = {.shear_share = 0.5}}}},
      {"condensed, share 0", {CondensedTangent{}}},
      {"mean of eq. 6 and condensed, share 0",
       {[](fault_benchmarks::Grains const& packing, auto const& law) -> scarp::VoigtTangent<2> {
         return (ElasticContactTangent{}(packing, law) + CondensedTangent{}(packing, law)) / 2.0;
       }}}};
  fmt::print(
      "| solver | tangent | h/H reached | steps | refused | iterations | million DEM steps | CPU s |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (auto const& candidate : candidates) {
    run<scarp::FrozenTangent, scarp::AndersonMixing>("frozen, Anderson", candidate, study);
  }
  for (auto const& candidate : candidates) run<scarp::PointSecant, scarp::PlainStep>("point secant", candidate, study);
}

// SPDX-License-Identifier: BSL-1.0
// Which iteration brings the fault scene into balance with the fewest DEM steps? The quick free-field scene (220 triangles,
// 100 grains, one packing) to h/H = 0.03 at a residual of 5e-3 with every pair of tangent rule and mixing.
#include <benchmark/benchmark.h>

#include "../examples/fault_rupture/scenes.hpp"
#include "scarp/solver/anderson_mixing.hpp"
#include "scarp/solver/frozen_tangent.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace {

using fault_rupture::Sand;

fault_rupture::Choice quick_choice() {
  fault_rupture::Choice choice;
  choice.size = 5.0;
  choice.grains = 100;
  choice.throw_over_depth = 0.03;
  return choice;
}

template <class Rule, class Mixing>
void solve(benchmark::State& state) {
  static auto const study = fault_rupture::make<fault_rupture::SandFreeField>(quick_choice());
  scarp::FreeFieldFault<Sand, scarp::QuasiNewton<Rule, Mixing>> scene;
  scene.soil = study.soil;
  scene.layer = study.layer;
  scene.fault = study.fault;
  scene.throw_to = study.throw_to;
  scene.stepping = study.stepping;
  scarp::ThreadExecutor executor(0);
  for (auto _ : state) {
    auto problem = scene.problem(executor);
    scarp::NoObserver observer;
    scene.settle(problem, observer);
    auto const report = scene.rupture(problem, observer);
    state.counters["reached_h_over_H"] = report.load / scene.layer.depth;
    state.counters["steps"] = report.steps;
    state.counters["refused"] = report.refused;
    state.counters["iterations"] = static_cast<double>(report.iterations);
    state.counters["dem_steps"] = static_cast<double>(report.inner_steps);
    state.counters["largest_residual"] = report.largest_residual;
  }
}

BENCHMARK(solve<scarp::PointSecant, scarp::PlainStep>)
    ->Name("fault/point_secant/plain")
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();
BENCHMARK(solve<scarp::PointSecant, scarp::AndersonMixing>)
    ->Name("fault/point_secant/anderson")
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();
BENCHMARK(solve<scarp::FrozenTangent, scarp::AndersonMixing>)
    ->Name("fault/frozen/anderson")
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();
BENCHMARK(solve<scarp::FrozenTangent, scarp::PlainStep>)
    ->Name("fault/frozen/plain")
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();

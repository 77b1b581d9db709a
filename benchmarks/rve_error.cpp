// SPDX-License-Identifier: BSL-1.0
// How wrong is one RVE for the steps it took? Pure shear of 400 ellipses at 200 kPa in ten increments of 1e-3 against the
// quasi-static answer (strain per step 1e-7), for several rates and shares of steps spent on settling without strain.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/disc_grading.hpp"
#include "scarp/dem/ellipse_grading.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/homogenise/balance.hpp"

namespace {

using Packing = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
constexpr scarp::LinearFrictional law{6e6, 6e6, 0.55};
constexpr double pressure = 200e3;
constexpr int increments = 10;
constexpr double increment = 1e-3;

Packing const& start() {
  static Packing const packing = [] {
    scarp::Cloud<scarp::EllipseGrading> const cloud{.grading = {.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75},
                                                    .grains = 400,
                                                    .density = 2650.0,
                                                    .thickness = 0.2};
    return scarp::IsotropicPreparation{.pressure = pressure}.prepare(cloud.make<Packing>(), law).packing;
  }();
  return packing;
}

/// Stress at the end of each increment; `unbalanced` receives the mean ratio.
std::vector<scarp::Tensor<2>> shear(int driven, int settling, double damping, double& unbalanced) {
  Packing packing = start();
  scarp::TimeStepper<Packing> stepper;
  stepper.damping.factor = damping;
  scarp::Tensor<2> strain_step = scarp::Tensor<2>::Zero();
  strain_step.diagonal() << increment / driven, -increment / driven;
  std::vector<scarp::Tensor<2>> stresses;
  unbalanced = 0.0;
  for (int k = 0; k < increments; ++k) {
    for (int step = 0; step < driven; ++step) stepper.step(packing, law, strain_step);
    for (int step = 0; step < settling; ++step) stepper.step(packing, law, scarp::Tensor<2>::Zero());
    auto const state = scarp::balance(packing, law);
    stresses.push_back(state.stress);
    unbalanced += state.unbalanced_ratio / increments;
  }
  return stresses;
}

/// Arguments: DEM steps per increment, per cent of them spent on settling, damping factor in per cent.
void rve_error(benchmark::State& state) {
  static std::vector<scarp::Tensor<2>> const quasi_static = [] {
    double ignored = 0.0;
    return shear(static_cast<int>(increment / 1e-7), 2000, 0.2, ignored);
  }();
  int const steps = static_cast<int>(state.range(0));
  int const settling = steps * static_cast<int>(state.range(1)) / 100;
  double const damping = static_cast<double>(state.range(2)) / 100.0;
  double unbalanced = 0.0;
  std::vector<scarp::Tensor<2>> stresses;
  for (auto _ : state) stresses = shear(steps - settling, settling, damping, unbalanced);
  double squared = 0.0;
  for (std::size_t k = 0; k < stresses.size(); ++k) squared += (stresses[k] - quasi_static[k]).squaredNorm();
  state.counters["strain_per_step"] = increment / steps;
  state.counters["error_over_pressure"] = std::sqrt(squared / increments) / pressure;
  state.counters["unbalanced_ratio"] = unbalanced;
}

BENCHMARK(rve_error)
    ->ArgNames({"steps", "settling_percent", "damping_percent"})
    ->ArgsProduct({{25, 50, 100, 200}, {0, 20}, {20, 50}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();

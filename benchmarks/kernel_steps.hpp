// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <limits>

#include "kernel_packings.hpp"
#include "shared/state_bytes.hpp"

namespace scarp_benchmark {

inline auto const seconds_each = benchmark::Counter::kIsRate | benchmark::Counter::kInvert;

inline void count_pairs(benchmark::State& state, std::size_t near_pairs, std::size_t contacts) {
  using benchmark::Counter;
  auto const steps = static_cast<double>(state.iterations());
  state.counters["us_per_step"] = Counter(steps * 1e-6, seconds_each);
  state.counters["ns_per_near_pair"] = Counter(steps * static_cast<double>(near_pairs) * 1e-9, seconds_each);
  state.counters["near_pairs"] = static_cast<double>(near_pairs);
  state.counters["contacts"] = static_cast<double>(contacts);
}

/// Time of a step in slow shear. The list of pairs is made anew as often as it must: thousands of steps apart, which
/// means not at all where there are so many grains that fewer are measured.
template <class PackingType>
void dem_step(benchmark::State& state, int grains, Numbering numbering = Numbering::at_random) {
  auto const law = law_of_study<PackingType>();
  PackingType packing = sheared<PackingType>(grains, numbering);
  scarp::TimeStepper<PackingType> stepper;
  SlowShear<PackingType::dim> shear;
  packing.pairs.drift = std::numeric_limits<double>::infinity();  // begin with a new list of pairs
  static_cast<void>(stepper.step(packing, law, shear.next()));
  for (auto _ : state) {
    if (!stepper.step(packing, law, shear.next()).acceptable()) {
      state.SkipWithError("the packing failed");
      break;
    }
  }
  count_pairs(state, packing.pairs.count(), contact_count(packing, law));
  state.counters["state_bytes"] = static_cast<double>(benchmarks::state_bytes(packing));
}

template <class Measure>
void declare(std::string const& name, Measure&& measure) {
  benchmark::RegisterBenchmark(name.c_str(), measure)->Unit(benchmark::kMicrosecond);
}

template <class PackingType>
void declare_steps(std::string const& name, std::vector<int> const& numbers) {
  for (int const grains : numbers)
    declare(fmt::format("dem_step/{}/{}", name, grains),
            [grains](auto& state) { dem_step<PackingType>(state, grains); });
}

/// Runs what was declared. \return exit code of the program
inline int run(int argc, char** argv, char const* program) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    benchmark::RunSpecifiedBenchmarks();
  } catch (std::exception const& problem) {
    fmt::print(stderr, "{}: {}\n", program, problem.what());
    return 1;
  }
  return 0;
}

}  // namespace scarp_benchmark

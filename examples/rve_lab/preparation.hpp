// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstdio>
#include <limits>
#include <mutex>

#include "../shared/print.hpp"
#include "../shared/sand/preparation.hpp"
#include "packings.hpp"
#include "scarp/core/process.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace rve_lab {

template <class PackingType>
PackingType Preparation<PackingType>::printed(Sand const& sand, Law const& law) {
  auto const progress = [](std::string const& text) { examples::print(stdout, "{}\n", text); };
  return examples::prepared<PackingType>(sand, law, sand.seed, progress, sand.void_ratio_tolerance);
}

template <class PackingType>
std::vector<PackingType> Preparation<PackingType>::of_seeds(Sand const& sand, Law const& law,
                                                            std::vector<std::uint64_t> const& seeds, int threads) {
  std::size_t const count = seeds.size();
  std::vector<PackingType> packings(count);
  std::size_t ready = 0;
  std::mutex printing;
  scarp::ThreadExecutor const executor(std::min(threads, scarp::usable_processors()));
  executor.for_each(static_cast<int>(count), [&](int number) {
    auto const k = static_cast<std::size_t>(number);
    try {
      packings[k] = examples::prepared<PackingType>(sand, law, seeds[k], {}, sand.void_ratio_tolerance);
    } catch (scarp::PreparationError const& problem) {
      throw scarp::PreparationError(fmt::format("seed {}: {}", seeds[k], problem.what()));
    } catch (scarp::InputError const& problem) {
      scarp::reject("seed {}: {}", seeds[k], problem.what());
    }
    std::lock_guard const lock(printing);
    ++ready;
    constexpr std::size_t lines = 10;
    if (ready * lines / count == (ready - 1) * lines / count) return;
    examples::print(stdout, "{} of {} packings are prepared\n", ready, count);
    std::fflush(stdout);
  });
  return packings;
}

template <class PackingType>
PackingType Preparation<PackingType>::nearest(Sand const& sand, Law const& law, double& isotropic_void_ratio) {
  return examples::prepared<PackingType>(sand, law, sand.seed, {}, std::numeric_limits<double>::infinity(),
                                         &isotropic_void_ratio);
}

}  // namespace rve_lab

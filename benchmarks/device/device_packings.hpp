// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include "../kernel_packings.hpp"
#include "scarp/core/process.hpp"

namespace scarp_benchmark {

using Grains = StudyPacking<scarp::Ellipse>;
using Narrow = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional, float>;

/// Displacement gradient of a DEM step of a point; every point has another one.
inline scarp::Tensor<2> strain_step(double size, std::size_t point) {
  scarp::Tensor<2> strain;
  strain << 1.0, 0.7, -0.2, -1.3;
  return strain * (size * (1.0 + 1e-3 * static_cast<double>(point % 97)));
}

/// Calls work(k) for all k below `count` on all processors.
template <class Work>
void on_all_processors(std::size_t count, Work const& work) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> team;
  for (int thread = 0; thread < scarp::usable_processors(); ++thread) {
    team.emplace_back([&] {
      for (std::size_t k = next++; k < count; k = next++) work(k);
    });
  }
}

/// Packings at 200 kPa that have been sheared a little, so that their grains move.
inline std::vector<Grains> packings_of(int grains, std::size_t count = 8) {
  std::vector<Grains> packings(count);
  auto const law = law_of_study<Grains>();
  on_all_processors(count, [&](std::size_t k) {
    scarp::Cloud<scarp::EllipseGrading> const cloud{.grading = grading_of_study<scarp::Ellipse>(),
                                                    .grains = grains,
                                                    .density = 2650.0,
                                                    .thickness = 0.2,
                                                    .seed = k + 1};
    scarp::IsotropicPreparation const preparation{.pressure = pressure};
    packings[k] = preparation.prepare(cloud.make<Grains>(), law).packing;
    scarp::TimeStepper<Grains> stepper;
    scarp::StepObservation<2> seen;
    for (int step = 0; step < 200; ++step) static_cast<void>(stepper.step(packings[k], law, strain_step(2e-6, k)));
    static_cast<void>(stepper.observe(packings[k], law, seen));
  });
  return packings;
}

/// The packings in single precision; shear forces start from zero.
inline std::vector<Narrow> narrow(std::vector<Grains> const& packings) {
  std::vector<Narrow> made;
  for (auto const& packing : packings) {
    made.push_back(converted<Narrow>(packing));
    static_cast<void>(scarp::TimeStepper<Narrow>{}.refresh(made.back(), law_of_study<Narrow>()));
  }
  return made;
}

}  // namespace scarp_benchmark

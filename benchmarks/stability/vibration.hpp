// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>

#include "scarp/core/random.hpp"
#include "scarp/dem/stability_limit.hpp"
#include "scarp/dem/time_stepping.hpp"

/// Free vibration of packings in balance: up to which time step does it stay bounded?
namespace stability {

/// Time steps [s] of a packing.
struct Limits {
  double predicted = 0.0;  ///< stability_limit
  double bisected = 0.0;
  double by_default = 0.0;  ///< what TimeStepper would take
};

namespace detail {

/// Kinetic energy [J].
template <class PackingType>
double motion(PackingType const& packing) {
  double sum = 0.0;
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    for (double const v : packing.velocity.row(i)) sum += 0.5 * v * v / packing.population->inverse_mass()[i];
    for (double const w : packing.spin.row(i)) sum += 0.5 * w * w / packing.population->inverse_inertia()[i];
  }
  return sum;
}

template <class PackingType>
scarp::TimeStepper<PackingType> undamped() {
  scarp::TimeStepper<PackingType> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  return stepper;
}

/// Near its limit the scheme amplifies a vibration 1/(1 - (dt/limit)^2) times and no more; 1e6 is beyond 0.999999 of
/// it, and one percent above it the slowest growth reaches 1e6 within 70 steps.
template <class PackingType>
bool grows(PackingType packing, typename PackingType::Law const& law, double time_step, int steps) {
  constexpr double nudge = 1e-9;  // [m/s]: the vibration stays far smaller than any overlap
  constexpr double boundless = 1e6;
  scarp::Random random(7);
  double const radius = packing.population->largest_radius();
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    for (int a = 0; a < PackingType::dim; ++a) packing.velocity(i, a) = random.uniform(-nudge, nudge);
    for (int k = 0; k < scarp::spin_size<PackingType::dim>; ++k) {
      packing.spin(i, k) = random.uniform(-nudge, nudge) / radius;
    }
  }
  packing.last_move = {};
  packing.pairs.critical_step = time_step;
  auto stepper = undamped<PackingType>();
  stepper.time_step_share = 1.0;
  double const start = motion(packing);
  for (int step = 0; step < steps; ++step) {
    if (!stepper.step(packing, law, scarp::Tensor<PackingType::dim>::Zero()).acceptable()) return true;
    if (!(motion(packing) < boundless * start)) return true;
  }
  return false;
}

}  // namespace detail

/// A packing in balance whose pair list is made.
template <class PackingType>
Limits limits_of(PackingType const& packing, typename PackingType::Law const& law, int steps = 400) {
  Limits limits{.predicted = scarp::stability_limit(packing, law),
                .by_default = scarp::usual_time_step_share * packing.pairs.critical_step};
  double stable = 0.1 * limits.predicted;
  double unstable = 10.0 * limits.predicted;
  if (detail::grows(packing, law, stable, steps) || !detail::grows(packing, law, unstable, steps)) return limits;
  while (unstable > 1.004 * stable) {
    double const middle = std::sqrt(stable * unstable);
    (detail::grows(packing, law, middle, steps) ? unstable : stable) = middle;
  }
  limits.bisected = std::sqrt(stable * unstable);
  return limits;
}

}  // namespace stability

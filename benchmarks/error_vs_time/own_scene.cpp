// SPDX-License-Identifier: BSL-1.0
// Your own scene: an aggregate of settings and a function that runs it. Here a packing as provider is sheared at
// constant volume in load steps, as a point of a boundary-value problem would require it.
#include "rve_packings.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "subjects.hpp"
#include "sweep.hpp"

namespace error_vs_time {
namespace {

struct OnePacking {
  int seed;
  Grains at(scarp::Site<2> const&) const { return consolidated(400, seed); }
};

struct Settings {
  double load_step = 1e-3, strain_per_step = 1e-5, inertial_number = 5e-3;
  int min_steps = 20;
};

Measured shear(Settings const& settings, int repetition) {
  scarp::DemRve<Grains, OnePacking> const soil{.law = examples::study_law(),
                                               .source = {repetition + 1},
                                               .strain_per_step = settings.strain_per_step,
                                               .inertial_number = settings.inertial_number,
                                               .min_steps = settings.min_steps};
  Measured measured;
  scarp::Gradient<2> const increment{{0.0, settings.load_step}, {0.0, 0.0}};
  auto state = soil.initial_state({});
  auto trial = state;
  for (double strain = 0.0; strain < 0.02 - 1e-9; strain += settings.load_step, std::swap(state, trial)) {
    measured.inner_steps += soil.plan(state, increment);
    measured.verdict = soil.respond(state, increment, trial).verdict;
    if (!measured.verdict.acceptable()) return measured;
  }
  measured.add("stress at 2 %", Eigen::VectorXd(soil.stress(state)));
  return measured;
}

SweepTable sweep_provider(Options const& options) {
  Sweep sweep("rve_provider", Settings{}, shear);
  sweep.reference({.load_step = 1e-4, .strain_per_step = options.quick ? 1e-6 : 1e-7});
  sweep.vary("load step", &Settings::load_step, {4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4});
  sweep.vary("strain per step", &Settings::strain_per_step, {5e-5, 2e-5, 1e-5, 5e-6, 2e-6});
  sweep.vary("inertial number", &Settings::inertial_number, {5e-3, 2e-3, 1e-3, 5e-4});
  sweep.vary("least steps", &Settings::min_steps, {20, 100, 400});
  return sweep.run(options.repetitions_or(options.quick ? 1 : 5));
}

bool const registered =
    register_subject({"rve_provider", "a packing as provider, strained in load steps", sweep_provider});

}  // namespace
}  // namespace error_vs_time

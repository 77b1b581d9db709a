// SPDX-License-Identifier: BSL-1.0
#include "fault_runs.hpp"
#include "scarp/measure/sweep.hpp"
#include "subjects.hpp"

namespace error_vs_time {

namespace {

auto with(FaultSolver solver) {
  return [solver](FaultSettings& settings, double gradient) {
    settings.solver = solver;
    settings.largest_gradient = gradient;
  };
}

/// Every seed is compared with its own reference.
scarp::SweepTable fault(Options const& options) {
  FaultSettings base = fault_rupture_defaults();
  if (options.quick) {
    base.throw_over_depth = 0.0015;
    base.grains = 50;
  }
  scarp::Sweep sweep("free-field fault", base, sand_fault);
  auto tight = base;
  tight.tolerance = base.tolerance / 5.0;
  tight.largest_gradient = base.largest_gradient / 4.0;
  sweep.reference(tight);
  sweep.vary("force tolerance", &FaultSettings::tolerance, {1e-2, 3e-3, 3e-4});
  sweep.vary("gradient of a load step", &FaultSettings::largest_gradient, {0.02, 0.01, 0.0025});
  sweep.vary("Lazy tolerance", &FaultSettings::lazy, {0.01, 0.03});
  sweep.vary("least DEM steps", &FaultSettings::least_steps, {5});
  sweep.vary("strain per DEM step", &FaultSettings::strain_per_step, {3e-5});
  sweep.vary("along iterates, gradient", with(FaultSolver::along_iterates), {0.01, 0.005, 0.0025});
  sweep.vary("frozen tangent with BFGS, gradient", with(FaultSolver::frozen_bfgs), {0.005});
  sweep.vary("dynamic relaxation, gradient", with(FaultSolver::relaxation), {0.005});
  sweep.vary("condensed tangent", &FaultSettings::condensed, {true});
  auto halved = base;
  halved.largest_gradient = base.largest_gradient / 2.0;
  auto lazy = halved;
  lazy.lazy = 0.01;
  sweep.also("Lazy 0.01, gradient halved", lazy);
  halved.tolerance = 3.0 * base.tolerance;
  sweep.also("tolerance tripled, gradient halved", halved);
  sweep.vary("cell in the band [m]", &FaultSettings::size, options.quick ? std::vector{7.0} : std::vector{7.0, 3.5});
  sweep.vary_sample(
      "grains", [](FaultSettings& settings, double grains) { settings.grains = static_cast<int>(grains); },
      options.quick ? std::vector{30.0} : std::vector{50.0});
  return sweep.run(options.repetitions_or(options.quick ? 1 : 3));
}

bool const registered =
    register_subject({.name = "fault_free_field",
                      .question = "are the defaults of fault_rupture on the front of error against CPU time?",
                      .run = fault,
                      .wanted_errors = {0.05, 0.03, 0.02, 0.01}});

}  // namespace

}  // namespace error_vs_time

// SPDX-License-Identifier: BSL-1.0
#include "fault_runs.hpp"
#include "scarp/measure/sweep.hpp"
#include "subjects.hpp"

namespace error_vs_time {

namespace {

FaultSettings base_of(Options const& options) {
  FaultSettings base = fault_rupture_defaults();
  if (options.quick) {
    base.throw_over_depth = 0.0015;
    base.grains = 50;
  }
  return base;
}

FaultSettings tight(FaultSettings settings) {
  settings.tolerance /= 5.0;
  settings.largest_gradient /= 4.0;
  return settings;
}

/// Meshes of as many triangles whose edges point elsewhere.
void vary_directions(scarp::Sweep<FaultSettings>& sweep) {
  auto const run = [](auto pattern, FaultSettings settings, int repetition) {
    settings.pattern = pattern.value;
    return sand_fault(settings, repetition);
  };
  sweep.vary("aspect of a cell", &FaultSettings::aspect, {1.73, 2.5});
  sweep.vary_over<LeftPattern, RightPattern, JitteredPattern>("pattern", {"left", "right", "jittered"}, run);
}

/// Every seed is compared with its own reference.
scarp::SweepTable fault(Options const& options) {
  auto const base = base_of(options);
  scarp::Sweep sweep("free-field fault", base, sand_fault);
  sweep.reference(tight(base));
  sweep.vary("force tolerance", &FaultSettings::tolerance, {1e-2, 3e-3, 3e-4});
  sweep.vary("gradient of a load step", &FaultSettings::largest_gradient, {0.02, 0.01, 0.0025});
  sweep.vary("Lazy tolerance", &FaultSettings::lazy, {0.01, 0.03});
  sweep.vary("least DEM steps", &FaultSettings::least_steps, {5});
  sweep.vary("strain per DEM step", &FaultSettings::strain_per_step, {3e-5});
  auto halved = base;
  halved.largest_gradient = base.largest_gradient / 2.0;
  auto lazy = halved;
  lazy.lazy = 0.01;
  sweep.also("Lazy 0.01, gradient halved", lazy);
  halved.tolerance = 3.0 * base.tolerance;
  sweep.also("tolerance tripled, gradient halved", halved);
  sweep.vary("cell in the band [m]", &FaultSettings::size, options.quick ? std::vector{7.0} : std::vector{7.0, 3.5});
  vary_directions(sweep);
  sweep.vary_sample(
      "grains", [](FaultSettings& settings, double grains) { settings.grains = static_cast<int>(grains); },
      options.quick ? std::vector{30.0} : std::vector{50.0});
  return sweep.run(options.repetitions_or(options.quick ? 1 : 3));
}

/// Cells of 3.5 m, of which 3.4 go into the length; references have the same length.
scarp::SweepTable fault_with_length(Options const& options) {
  auto base = base_of(options);
  if (!options.quick) base.size = 3.5;
  base.length = 12.0;
  scarp::Sweep sweep("free-field fault with a length", base, sand_fault);
  sweep.reference(tight(base));
  vary_directions(sweep);
  double const cells = base.length / base.size;
  sweep.vary("cell in the band [m]", &FaultSettings::size, options.quick ? std::vector{7.0} : std::vector{5.0, 2.5});
  sweep.vary(
      "length [m], as many cells in it",
      [cells](FaultSettings& settings, double length) {
        settings.length = length;
        settings.size = length / cells;
      },
      options.quick ? std::vector{16.97} : std::vector{8.49, 6.0});
  return sweep.run(options.repetitions_or(options.quick ? 1 : 3));
}

/// The main job's scene with cells of 3.5 m for 2.5 m, a length that is as well resolved, and a quarter of the grains.
scarp::SweepTable objective_fault(Options const& options) {
  auto base = base_of(options);
  if (!options.quick) {
    base.size = 3.5;
    base.throw_over_depth = 0.085;
  }
  base.length = 12.0;
  base.packings = 16;
  base.strain_per_step = 2e-5;
  base.unbalanced = 0.1;
  base.most_seconds = 2000.0;
  auto reference = tight(base);
  reference.strain_per_step /= 4.0;
  reference.unbalanced /= 4.0;
  reference.least_steps *= 2;
  scarp::Sweep sweep("free-field fault, objective", base, sand_fault);
  sweep.reference(reference);
  sweep.vary("strain per DEM step", &FaultSettings::strain_per_step, {5e-6, 1e-5, 4e-5});
  sweep.vary("least DEM steps", &FaultSettings::least_steps, {5, 40});
  sweep.vary("inertial number", &FaultSettings::inertial_number, {2.5e-3, 1e-2});
  sweep.vary("unbalanced ratio", &FaultSettings::unbalanced, {0.025, 0.05, 0.2});
  sweep.vary("force tolerance", &FaultSettings::tolerance, {1e-2, 3e-3, 3e-4});
  sweep.vary("gradient of a load step", &FaultSettings::largest_gradient, {0.02, 0.01, 0.0025});
  sweep.vary("Lazy tolerance", &FaultSettings::lazy, {0.003, 0.01, 0.03});
  auto both = base;
  both.strain_per_step = 1e-5;
  both.unbalanced = 0.05;
  sweep.also("strain 1e-5, unbalanced ratio 0.05", both);
  both = base;
  both.tolerance = 3e-3;
  both.least_steps = 10;
  sweep.also("tolerance 3e-3, least steps 10", both);
  both = base;
  both.tolerance = 3e-3;
  both.largest_gradient = 2.0 * base.largest_gradient;
  sweep.also("tolerance 3e-3, gradient 0.01", both);
  return sweep.run(options.repetitions_or(options.quick ? 1 : 3));
}

bool const registered_objective =
    register_subject({.name = "fault_objective",
                      .question = "are the defaults of fault_rupture with a length on the front?",
                      .run = objective_fault,
                      .wanted_errors = {0.1, 0.05, 0.03, 0.02}});
bool const registered_local =
    register_subject({.name = "fault_free_field",
                      .question = "are the defaults of fault_rupture on the front of error against CPU time?",
                      .run = fault,
                      .wanted_errors = {0.05, 0.03, 0.02, 0.01}});
bool const registered_nonlocal =
    register_subject({.name = "fault_free_field_nonlocal",
                      .question = "do the directions of the mesh matter with an intrinsic length of 12 m?",
                      .run = fault_with_length,
                      .wanted_errors = {0.05, 0.03, 0.02, 0.01}});

}  // namespace

}  // namespace error_vs_time

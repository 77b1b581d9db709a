// SPDX-License-Identifier: BSL-1.0
// One packing along the paths of the laboratory, against its own quasi-static response.
#include "../../examples/shared/laboratory_loadings.hpp"
#include "rve_paths.hpp"
#include "subjects.hpp"
#include "sweep.hpp"

namespace error_vs_time {
namespace {

using scarp::LocalDamping;

struct DoublePrecision {};
struct SinglePrecision {};
struct MassProportional {};  ///< nothing by forces
struct LinearSprings {};
struct HertzMindlinSprings {};

/// Seeds begin at 1, so that no sample is the one that other pages show by chance alone.
Grains const& sample(RveSettings const& settings, int repetition) {
  return consolidated(settings.grains, repetition + 1);
}

LocalDamping damping_of(RveSettings const& settings) { return {.factor = settings.damping}; }

Measured run_path(RveSettings const& settings, int repetition, Path const& path) {
  return walk(sample(settings, repetition), examples::study_law(), damping_of(settings), settings, path);
}

Measured run_with(SinglePrecision, RveSettings const& settings, int repetition, Path const& path) {
  return walk(in_single_precision(sample(settings, repetition)), examples::study_law(), damping_of(settings), settings,
              path);
}
Measured run_with(DoublePrecision, RveSettings const& settings, int repetition, Path const& path) {
  return run_path(settings, repetition, path);
}
Measured run_with(LocalDamping, RveSettings const& settings, int repetition, Path const& path) {
  return run_path(settings, repetition, path);
}
Measured run_with(MassProportional, RveSettings const& settings, int repetition, Path const& path) {
  return walk(sample(settings, repetition), examples::study_law(), LocalDamping{.factor = 0.0, .drag = 0.02}, settings,
              path);
}
Measured run_with(LinearSprings, RveSettings const& settings, int repetition, Path const& path) {
  return run_path(settings, repetition, path);
}
Measured run_with(HertzMindlinSprings, RveSettings const& settings, int repetition, Path const& path) {
  auto const& linear = sample(settings, repetition);
  auto const law = matched_law(linear);
  return walk(relaxed(linear, law), law, damping_of(settings), settings, path);
}

SweepTable sweep_path(std::string const& name, Path const& path, Options const& options) {
  bool const quick = options.quick;
  RveSettings const base{.grains = quick ? 100 : 400};
  Sweep sweep(name, base,
              [&](RveSettings const& settings, int repetition) { return run_path(settings, repetition, path); });
  auto finest = base;
  finest.strain_per_step = quick ? 1e-6 : 1e-7;
  sweep.reference(finest);
  std::vector<double> rates{1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6};
  if (quick) rates = {1e-4, 5e-5, 2e-5, 1e-5, 5e-6};
  sweep.vary("strain per step", &RveSettings::strain_per_step, rates);
  sweep.vary("damping", &RveSettings::damping, {0.05, 0.1, 0.2, 0.4, 0.7});
  sweep.vary("time step share", &RveSettings::time_step_share, {0.25, 0.5, 0.78, 1.0, 1.2});
  sweep.vary("settling", &RveSettings::settling, {0.0, 0.2, 0.5, 0.8});
  sweep.vary("averaging window", &RveSettings::averaging_window, {0.0, 1e-4, 2e-4, 5e-4, 1e-3});
  if (path.volume_is_free)
    sweep.vary("servo response steps", &RveSettings::response_steps, {3.0, 5.0, 10.0, 20.0, 50.0});
  sweep.vary_sample(
      "grains", [](RveSettings& settings, double grains) { settings.grains = static_cast<int>(grains); },
      quick ? std::vector{50.0, 100.0} : std::vector{100.0, 200.0, 400.0, 800.0});
  auto const run = [&](auto const& policy, RveSettings const& settings, int repetition) {
    return run_with(policy, settings, repetition, path);
  };
  sweep.vary_over<LocalDamping, MassProportional>("damping kind", {"local 0.2", "mass-proportional 0.02"}, run);
  sweep.vary_over<DoublePrecision, SinglePrecision>("precision", {"double", "float"}, run);
  sweep.vary_over<LinearSprings, HertzMindlinSprings>("contact law", {"linear", "Hertz-Mindlin"}, run);
  return sweep.run(options.repetitions_or(quick ? 2 : 5));
}

SweepTable biaxial(Options const& options) {
  Path const path{.loading = [](double rate) { return scarp::drained_compression<2>(rate, confinement); },
                  .strain = options.quick ? 0.01 : 0.03,
                  .samples = options.quick ? 10 : 30};
  return sweep_path("rve_biaxial", path, options);
}

SweepTable simple_shear(Options const& options) {
  Path const path{.loading = [](double rate) { return examples::simple_shear_at_stress<2>(rate, confinement); },
                  .strain = options.quick ? 0.01 : 0.04,
                  .samples = options.quick ? 10 : 40};
  return sweep_path("rve_simple_shear", path, options);
}

SweepTable one_dimensional(Options const& options) {
  Path const path{.loading = scarp::oedometer<2>, .strain = 0.01, .samples = 10, .volume_is_free = false};
  return sweep_path("rve_k0", path, options);
}

bool const registered =
    register_subject({"rve_biaxial", "drained biaxial compression of a packing", biaxial}) &&
    register_subject({"rve_simple_shear", "simple shear of a packing at held stress", simple_shear}) &&
    register_subject({"rve_k0", "one-dimensional compression of a packing", one_dimensional});

}  // namespace
}  // namespace error_vs_time

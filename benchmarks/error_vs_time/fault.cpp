// SPDX-License-Identifier: BSL-1.0
// The free-field fault scene with a packing in every triangle and a nonlocal length, on a coarser mesh than the
// default's with a quarter of its grains.
#include <map>
#include <tuple>

#include "../../examples/shared/study/sand_free_field.hpp"
#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/fault/rupture_survey.hpp"
#include "scarp/points/nonlocal.hpp"
#include "subjects.hpp"
#include "sweep.hpp"

namespace error_vs_time {

namespace {

using fault_rupture::MeshPattern;
using fault_rupture::SandFreeField;

struct Sand : scarp::DemRve<fault_rupture::Grains, fault_rupture::Columns> {};
struct NonlocalSand : scarp::Nonlocal<Sand> {};

struct FaultSettings {
  double size = 3.5;  ///< of a cell in the band [m]; cells of another pattern or aspect give about as many triangles
  MeshPattern pattern = MeshPattern::crossed;
  double aspect = 1.0;   ///< height of a cell over its width
  double length = 12.0;  ///< nonlocal [m]
  double throw_over_depth = 0.085;
  int grains = 100;
  double tolerance = 1e-3;
  double max_displacement_gradient = 0.005;
  double strain_per_step = 2e-5;
  int min_steps = 20;
  double inertial_number = 5e-3;
  double unbalanced = 0.1;
  double max_seconds = 2000.0;  ///< CPU time
};

/// Ends a run between two attempts once its CPU time [s] is spent.
class CpuTimeLimit {
 public:
  explicit CpuTimeLimit(double most) : most_(most) {}

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const&) {}
  bool wants_stop() const { return time_.seconds() > most_; }

 private:
  double most_;
  scarp::CpuTime time_;
};

/// Packings are prepared once for each mesh, number of grains and seed, outside of the time that is measured.
SandFreeField const& prepared(FaultSettings const& settings, int seed) {
  static std::map<std::tuple<double, MeshPattern, double, int, int>, SandFreeField> made;
  std::tuple const key{settings.size, settings.pattern, settings.aspect, settings.grains, seed};
  if (auto const found = made.find(key); found != made.end()) return found->second;
  fault_rupture::Choice choice;
  bool const two_in_a_cell = settings.pattern == MeshPattern::left || settings.pattern == MeshPattern::right;
  choice.size = settings.size / std::sqrt(two_in_a_cell ? 2.0 * settings.aspect : settings.aspect);
  choice.pattern = settings.pattern;
  choice.aspect = settings.aspect;
  choice.grains = settings.grains;
  choice.packings = 16;
  choice.mirrored_packings = true;
  choice.seed = static_cast<std::uint64_t>(seed);
  return made.emplace(key, fault_rupture::make_sand_free_field(choice)).first->second;
}

/// Settlement over throw at fixed places of the initial surface, between the sides, which are prescribed.
Eigen::VectorXd settlements(std::vector<scarp::SurfacePoint> const& profile, double fault_throw) {
  constexpr int places = 29;
  double const left = profile.front().x_initial;
  double const right = profile.back().x_initial;
  Eigen::VectorXd found(places);
  for (int k = 0; k < places; ++k)
    found(k) = scarp::settlement_at(profile, left + (right - left) * (k + 1) / (places + 1)) / fault_throw;
  return found;
}

Measured sand_fault(FaultSettings const& settings, int repetition) {
  auto const& study = prepared(settings, repetition + 1);
  scarp::FreeFieldFault<NonlocalSand, scarp::QuasiNewton<>> scene;
  auto& sand = scene.soil.provider;
  sand.law = study.soil.provider.law;
  sand.source = study.soil.provider.source;
  sand.strain_per_step = settings.strain_per_step;
  sand.min_steps = settings.min_steps;
  sand.inertial_number = settings.inertial_number;
  sand.unbalanced_tolerance = settings.unbalanced;
  sand.pressure_floor = study.soil.provider.pressure_floor;
  scene.soil.length = settings.length;
  scene.ground.layer = study.ground.layer;
  scene.fault = study.fault;
  scene.throw_to = settings.throw_over_depth * scene.ground.layer.depth;
  scene.solver.tolerance = settings.tolerance;
  scene.stepping.max_displacement_gradient = settings.max_displacement_gradient;
  static scarp::SerialExecutor executor;
  auto problem = scene.problem(executor);
  CpuTimeLimit limit(settings.max_seconds);
  scarp::CpuTime const time;
  auto report = scene.settle(problem, limit);
  auto const rest = scarp::ground_at_rest(problem);
  if (report.verdict.acceptable()) report = scarp::joined(report, scene.rupture(problem, limit));
  Measured measured{.inner_steps = report.inner_steps, .verdict = report.verdict, .seconds = time.seconds()};
  if (!report.verdict.acceptable()) return measured;
  auto const& grid = problem.discretisation();
  auto const& mesh = grid.mesh();
  auto const at_rest = rest.of(mesh.nodes);
  auto const surface =
      scarp::rupture_survey(mesh, at_rest, grid.positions(), offset_at(scene.fault, report.load)).surface;
  measured.add("surface profile", settlements(scarp::surface_profile(mesh, at_rest, grid.positions()), report.load));
  measured.add("outcrop", surface.outcrop_x);
  measured.add("x05", surface.surface_x05);
  measured.add("x50", surface.surface_x50);
  measured.add("x95", surface.surface_x95);
  measured.add("band width", surface.outcrop_width);
  return measured;
}

/// Every seed is compared with its own reference, of the same length.
SweepTable fault(Options const& options) {
  FaultSettings base;
  if (options.quick) {
    base.size = 6.0;
    base.throw_over_depth = 0.0015;
    base.grains = 50;
  }
  auto reference = base;
  reference.tolerance /= 5.0;
  reference.max_displacement_gradient /= 4.0;
  reference.strain_per_step /= 4.0;
  reference.unbalanced /= 4.0;
  reference.min_steps *= 2;
  Sweep sweep("fault", base, sand_fault);
  sweep.reference(reference);
  sweep.vary("strain per DEM step", &FaultSettings::strain_per_step, {5e-6, 1e-5, 4e-5});
  sweep.vary("least DEM steps", &FaultSettings::min_steps, {5, 40});
  sweep.vary("inertial number", &FaultSettings::inertial_number, {2.5e-3, 1e-2});
  sweep.vary("unbalanced ratio", &FaultSettings::unbalanced, {0.025, 0.05, 0.2});
  sweep.vary("force tolerance", &FaultSettings::tolerance, {1e-2, 3e-3, 3e-4});
  sweep.vary("gradient of a load step", &FaultSettings::max_displacement_gradient, {0.02, 0.01, 0.0025});
  auto both = base;
  both.tolerance = 3e-3;
  both.max_displacement_gradient = 2.0 * base.max_displacement_gradient;
  sweep.also("tolerance 3e-3, gradient 0.01", both);
  sweep.vary("cell in the band [m]", &FaultSettings::size, options.quick ? std::vector{8.0} : std::vector{5.0, 2.5});
  sweep.vary("aspect of a cell", &FaultSettings::aspect, {1.73, 2.5});
  sweep.vary("pattern: left, right, jittered",
             [](FaultSettings& settings, double number) {
               constexpr MeshPattern patterns[] = {MeshPattern::left, MeshPattern::right, MeshPattern::jittered};
               settings.pattern = patterns[static_cast<int>(number)];
             },
             {0.0, 1.0, 2.0});
  sweep.vary_sample(
      "grains", [](FaultSettings& settings, double grains) { settings.grains = static_cast<int>(grains); },
      options.quick ? std::vector{30.0} : std::vector{50.0});
  return sweep.run(options.repetitions_or(options.quick ? 1 : 3));
}

bool const registered =
    register_subject({.name = "fault", .question = "are the defaults of fault_rupture on the front?", .run = fault});

}  // namespace

}  // namespace error_vs_time

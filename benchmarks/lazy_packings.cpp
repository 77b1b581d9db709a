// SPDX-License-Identifier: BSL-1.0
// What do packings that are asked only when needed save, and at what error? The free-field fault scene with `Lazy`
// packings against the same scene asked always; prints the table of docs/lazy.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../examples/shared/study/typed_scenes.hpp"
#include "scarp/constitutive/lazy.hpp"
#include "scarp/homogenise/condensed_tangent.hpp"
#include "scarp/measure/cpu_time.hpp"
#include "scarp/observe/ground_at_rest.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/observe/outcrop.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace {

using fault_rupture::Grains;
using Law = Grains::Law;

/// Any policy under one type, so that the scene is compiled once.
struct AnyTangent {
  std::function<scarp::VoigtTangent<2>(Grains const&, Law const&)> policy;

  scarp::VoigtTangent<2> operator()(Grains const& packing, Law const& law) const { return policy(packing, law); }
};

using Packings = scarp::DemRve<Grains, fault_rupture::Columns, AnyTangent>;

struct LazySand : scarp::Lazy<Packings> {};

struct LazyFreeField : scarp::FreeFieldFault<LazySand> {};

/// How many points of the accepted steps were answered by prediction.
struct PredictionCount : scarp::NeverStops {
  long predicted = 0;
  long all = 0;

  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& report) {
    if (!report.verdict.acceptable() || report.step == 0) return;
    for (int point = 0; point < problem.discretisation().point_count(); ++point) {
      problem.materials().visit(point, [&](auto const& field, int local) {
        ++all;
        if (!field.committed(local).skipped.isZero(0.0)) ++predicted;
      });
    }
  }
};

struct Outcome {
  std::vector<double> settlement;             ///< [m], of the surface's nodes
  std::vector<scarp::VoigtStress<2>> stress;  ///< [Pa], answered or predicted
  scarp::Outcrop outcrop;
};

struct Candidate {
  std::string name;
  double tolerance = 0.0;
  bool learns = true;
  AnyTangent tangent{scarp::ElasticContactTangent{}};
  int least_steps = 20;
  double residual = 5e-3;
};

struct Setting {
  fault_rupture::SandFreeField study;
  std::optional<Outcome> reference{};
};

LazyFreeField scene_of(Setting const& setting, Candidate const& candidate) {
  auto const& study = setting.study;
  LazyFreeField scene;
  Packings& packings = scene.soil.provider;
  packings.law = study.soil.provider.law;
  packings.source = study.soil.provider.source;
  packings.strain_per_step = study.soil.provider.strain_per_step;
  packings.least_steps = candidate.least_steps;
  packings.unbalanced_tolerance = study.soil.provider.unbalanced_tolerance;
  packings.loose_pressure = study.soil.provider.loose_pressure;
  packings.tangent_policy = candidate.tangent;
  scene.soil.tolerance = candidate.tolerance;
  scene.soil.loose_pressure = study.soil.provider.loose_pressure;
  if (!candidate.learns) scene.soil.learning_strain = 1e6;  // no answer reaches it
  scene.ground.layer = study.ground.layer;
  scene.fault = study.fault;
  scene.throw_to = study.throw_to;
  scene.solver.tolerance = candidate.residual;
  scene.solver.most_iterations = study.solver.most_iterations;
  scene.stepping = study.stepping;
  return scene;
}

/// Distance of all points' stresses, and the middle of the points' own ones, relative to the reference.
struct StressError {
  double all;
  double median;
};

StressError stress_error(Outcome const& outcome, Outcome const& reference) {
  double difference = 0.0;
  double whole = 0.0;
  std::vector<double> each;
  for (std::size_t k = 0; k < reference.stress.size(); ++k) {
    double const off = scarp::from_voigt_stress<2, double>(outcome.stress[k] - reference.stress[k]).squaredNorm();
    double const size = scarp::from_voigt_stress<2, double>(reference.stress[k]).squaredNorm();
    difference += off;
    whole += size;
    each.push_back(std::sqrt(off / size));
  }
  auto const middle = each.begin() + static_cast<std::ptrdiff_t>(each.size() / 2);
  std::nth_element(each.begin(), middle, each.end());
  return {std::sqrt(difference / whole), *middle};
}

double largest_difference(std::vector<double> const& one, std::vector<double> const& other) {
  double largest = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) largest = std::max(largest, std::abs(one[k] - other[k]));
  return largest;
}

void run(Setting& setting, Candidate const& candidate) {
  LazyFreeField const scene = scene_of(setting, candidate);
  scarp::ThreadExecutor executor(0);
  auto problem = scene.problem(executor);
  PredictionCount count;
  scarp::CpuTime const time;
  auto const settled = scene.settle(problem, count);
  auto const rest = scarp::ground_at_rest(problem);
  auto const report = scarp::joined(settled, scene.rupture(problem, count));
  double const cpu = time.seconds();

  auto const& grid = problem.discretisation();
  auto const profile = scarp::surface_profile(grid.mesh(), rest.of(grid.mesh()), grid.positions());
  Outcome outcome{{}, problem.committed_stresses(), scarp::outcrop(profile, report.load)};
  for (auto const& place : profile) outcome.settlement.push_back(place.settlement);
  if (!setting.reference) setting.reference = outcome;
  auto const& reference = *setting.reference;
  auto const error = stress_error(outcome, reference);
  fmt::print("| {} | {} / {} | {} | {:.0f} % | {:.3f} | {:.1f} | {:.2f} % | {:.1f} | {:.1f} % | {:.1f} % |\n",
             candidate.name, report.steps, report.refused, report.iterations,
             100.0 * static_cast<double>(count.predicted) / static_cast<double>(count.all),
             static_cast<double>(report.inner_steps) / 1e6, cpu,
             100.0 * largest_difference(outcome.settlement, reference.settlement) / report.load,
             outcome.outcrop.outcrop_x, 100.0 * error.all, 100.0 * error.median);
  if (!report.verdict.acceptable()) {
    fmt::print("stopped at h/H = {:.4f}: {}\n", report.load / scene.ground.layer.depth, name(report.verdict.reason));
  }
  std::fflush(stdout);
}

}  // namespace

/// Optional arguments: throw over depth (0.03), grains (200), width of a cell in the band (5 m), displacement gradient
/// that limits a load step (0.01), seed (1).
int main(int argc, char** argv) {
  auto const given = [&](int place, double otherwise) { return argc > place ? std::atof(argv[place]) : otherwise; };
  fault_rupture::Choice choice;
  choice.throw_over_depth = given(1, 0.03);
  choice.grains = static_cast<int>(given(2, 200.0));
  choice.size = given(3, 5.0);
  choice.largest_gradient = given(4, 0.01);
  choice.seed = static_cast<std::uint64_t>(given(5, 1.0));
  Setting setting{fault_rupture::make<fault_rupture::SandFreeField>(choice)};
  fmt::print(
      "| packings | steps / refused | iterations | predicted | million DEM steps | CPU s | surface | outcrop_x | "
      "stress, all | stress, median |\n|---|---|---|---|---|---|---|---|---|---|\n");
  run(setting, {.name = "asked always"});
  run(setting, {.name = "the same, residual 2.5e-3", .residual = 2.5e-3});
  run(setting, {.name = "the same, at least 5 DEM steps", .least_steps = 5});
  for (double const tolerance : {0.003, 0.01, 0.03, 0.1})
    run(setting, {.name = fmt::format("tolerance {}", tolerance), .tolerance = tolerance});
  run(setting, {.name = "0.01, at least 5 DEM steps", .tolerance = 0.01, .least_steps = 5});
  run(setting, {.name = "0.01, eq. 6, nothing learned", .tolerance = 0.01, .learns = false});
  run(setting, {.name = "0.01, condensed and learned",
                .tolerance = 0.01,
                .tangent = {scarp::CondensedTangent{.sliding = {.shear_share = 1.0}}}});
}

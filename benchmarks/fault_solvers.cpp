// SPDX-License-Identifier: BSL-1.0
// Which solver brings the fault scene into balance at the least cost? The quick free-field scene (220 triangles) under every
// setting of a list, against the first one at a fifth of the residual; prints the table of docs/solvers.md.
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <tuple>

#include "scarp/constitutive/perturbation_tangent.hpp"
#include "scarp/homogenise/condensed_tangent.hpp"
#include "scarp/homogenise/sliding_aware_tangent.hpp"
#include "scarp/solver/anderson_mixing.hpp"
#include "scarp/solver/bfgs_mixing.hpp"
#include "scarp/solver/dynamic_relaxation.hpp"
#include "scarp/solver/frozen_tangent.hpp"
#include "scarp/solver/line_search.hpp"
#include "timed_solver.hpp"

namespace {

using fault_benchmarks::AnyTangent;
using fault_benchmarks::End;
using fault_benchmarks::Setting;
using scarp::AlongIterates;
using scarp::AndersonMixing;
using scarp::BfgsMixing;
using scarp::ConsistentTangent;
using scarp::DynamicRelaxation;
using scarp::FrozenTangent;
using scarp::LineSearch;
using scarp::PlainStep;
using scarp::PointSecant;
using scarp::QuasiNewton;
using scarp::SparseLu;

/// A row of the table.
template <class SettingType>
End row(SettingType const& setting, fault_rupture::SandFreeField const& study, double tolerance, double seconds,
        End const* reference) {
  End const end = run(setting, study, tolerance, seconds);
  auto const& report = end.report;
  std::string differences = "| |";
  if (reference != nullptr && report.load == study.throw_to) {
    differences = fmt::format("{:.2f} | {:.2f} |", 100.0 * surface_difference(end, *reference) / study.throw_to,
                              100.0 * (end.reactions - reference->reactions).norm() / reference->reactions.norm());
  }
  fmt::print("| {} | {:.4f} | {:.1e} | {} | {} | {} | {:.2f} | {:.1f} | {}\n", setting.name,
             report.load / study.ground.layer.depth, report.largest_residual, report.steps, report.refused,
             report.iterations, static_cast<double>(report.inner_steps) / 1e6, end.cpu_seconds, differences);
  std::fflush(stdout);
  return end;
}

}  // namespace

/// Optional arguments: throw over depth (0.03), grains (100), residual (1e-3), wall time of each run [s] (120).
int main(int argc, char** argv) {
  auto const argument = [&](int k, double otherwise) { return argc > k ? std::atof(argv[k]) : otherwise; };
  auto const choice = fault_benchmarks::small_free_field(argc, argv);
  double const tolerance = argument(3, 1e-3);
  double const seconds = argument(4, 120.0);
  auto const study = fault_rupture::make<fault_rupture::SandFreeField>(choice);
  AnyTangent const condensed{scarp::CondensedTangent{}};
  AnyTangent const sliding{scarp::SlidingAwareTangent{}};
  AnyTangent const perturbed{scarp::PerturbationTangent{.complain = nullptr}};
  Setting<QuasiNewton<PointSecant>> const first{"point secant"};
  auto const settings = std::make_tuple(
      first, Setting<QuasiNewton<PointSecant>>{"point secant from condensed tangents", condensed},
      Setting<QuasiNewton<PointSecant>>{"point secant from sliding-aware tangents", sliding},
      Setting<QuasiNewton<PointSecant, AndersonMixing>>{"point secant, Anderson"},
      Setting<QuasiNewton<PointSecant, LineSearch<>>>{"point secant, line search"},
      Setting<QuasiNewton<PointSecant, PlainStep, SparseLu, AlongIterates>>{
          .name = "point secant along iterates", .few = 12, .many = 20, .most_iterations = 60},
      Setting<QuasiNewton<FrozenTangent, AndersonMixing>>{"frozen eq. 6, Anderson"},
      Setting<QuasiNewton<FrozenTangent, AndersonMixing>>{"frozen condensed, Anderson", condensed},
      Setting<QuasiNewton<FrozenTangent, BfgsMixing>>{"frozen eq. 6, BFGS"},
      Setting<QuasiNewton<FrozenTangent, BfgsMixing>>{"frozen condensed, BFGS", condensed},
      Setting<QuasiNewton<ConsistentTangent>>{"Newton, eq. 6"},
      Setting<QuasiNewton<ConsistentTangent>>{"Newton, sliding-aware", sliding},
      Setting<QuasiNewton<ConsistentTangent>>{"Newton, condensed", condensed},
      Setting<QuasiNewton<ConsistentTangent>>{"Newton, by trial", perturbed},
      Setting<DynamicRelaxation<>>{
          .name = "dynamic relaxation", .least_steps = 4, .few = 150, .many = 300, .most_iterations = 1000});
  fmt::print(
      "| solver | h/H | largest residual | steps | refused | iterations | million DEM steps | CPU s | surface, % of "
      "throw | reactions, % |\n|---|---|---|---|---|---|---|---|---|---|\n");
  Setting<QuasiNewton<PointSecant>> tight = first;
  tight.name = "point secant, a fifth of the residual";
  tight.most_iterations = 60;
  tight.residual = 0.2;
  End const reference = row(tight, study, tolerance, 4.0 * seconds, nullptr);
  std::apply([&](auto const&... setting) { (row(setting, study, tolerance, seconds, &reference), ...); }, settings);
}

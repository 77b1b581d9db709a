// SPDX-License-Identifier: BSL-1.0
// Is a cheaper solver as accurate? The quick free-field scene over an ensemble of packings: each solver's mean over the seeds
// against that of the first one, which is at a fifth of the residual and half the load steps, beside the scatter of the seeds.
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <tuple>

#include "scarp/solver/dynamic_relaxation.hpp"
#include "timed_solver.hpp"

namespace {

using fault_benchmarks::End;
using fault_benchmarks::Setting;
using scarp::AlongIterates;
using scarp::PlainStep;
using scarp::PointSecant;
using scarp::QuasiNewton;
using scarp::SparseLu;

/// What the seeds of one setting gave, a column for each.
struct Ensemble {
  Eigen::MatrixXd settlements;  ///< over the throw
  Eigen::MatrixXd reactions;    ///< [N]
  Eigen::VectorXd outcrops;     ///< [m]
  double cpu_seconds = 0.0;
  long steps = 0;
  long iterations = 0;
  int unfinished = 0;
};

template <class SettingType>
Ensemble ensemble(SettingType const& setting, fault_rupture::Choice choice, double tolerance, int seeds) {
  Ensemble all;
  for (int k = 0; k < seeds; ++k) {
    choice.seed = static_cast<std::uint64_t>(k + 1);
    auto const study = fault_rupture::make<fault_rupture::SandFreeField>(choice);
    End const end = run(setting, study, tolerance, 1e9);
    if (k == 0) {
      all.settlements.resize(static_cast<Eigen::Index>(end.surface.size()), seeds);
      all.reactions.resize(end.reactions.size(), seeds);
      all.outcrops.resize(seeds);
    }
    for (std::size_t j = 0; j < end.surface.size(); ++j) {
      all.settlements(static_cast<Eigen::Index>(j), k) = end.surface[j].settlement / study.throw_to;
    }
    all.reactions.col(k) = end.reactions;
    all.outcrops(k) = scarp::outcrop(end.surface, study.throw_to).outcrop_x;
    all.cpu_seconds += end.cpu_seconds;
    all.steps += end.report.steps;
    all.iterations += end.report.iterations;
    if (!end.report.verdict.acceptable()) ++all.unfinished;
    fmt::print(stderr, "{}, seed {}: {} steps, {} refused, {} iterations, {:.1f} CPU s, h/H {:.4f}\n", setting.name,
               k + 1, end.report.steps, end.report.refused, end.report.iterations, end.cpu_seconds,
               end.report.load / study.ground.layer.depth);
  }
  return all;
}

double root_mean_square(Eigen::VectorXd const& values) {
  return values.norm() / std::sqrt(static_cast<double>(values.size()));
}

/// Norms over the rows of the mean over the columns, and of the standard deviation between them.
struct Moments {
  double mean;
  double scatter;
};

Moments moments(Eigen::MatrixXd const& columns) {
  Eigen::VectorXd const mean = columns.rowwise().mean();
  double const freedom = static_cast<double>(columns.cols() - 1);
  Eigen::VectorXd const variance = (columns.colwise() - mean).rowwise().squaredNorm() / freedom;
  return {root_mean_square(mean), std::sqrt(variance.mean())};
}

void print_row(std::string const& name, Ensemble const& all, Ensemble const& reference) {
  auto const seeds = static_cast<double>(all.outcrops.size());
  auto const surface = moments(all.settlements - reference.settlements);
  auto const reactions = moments(all.reactions - reference.reactions);
  double const force = moments(reference.reactions).mean;
  auto const outcrop = moments(all.outcrops.transpose());
  fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.2f} ({:.2f}) | {:.2f} | {:.2f} ({:.2f}) | {:.2f} | {:.2f} ± {:.2f} |\n",
             name, all.unfinished, static_cast<double>(all.iterations) / static_cast<double>(all.steps),
             all.cpu_seconds / seeds, 100.0 * surface.mean, 100.0 * surface.scatter / std::sqrt(seeds),
             100.0 * moments(all.settlements).scatter, 100.0 * reactions.mean / force,
             100.0 * reactions.scatter / force / std::sqrt(seeds), 100.0 * moments(all.reactions).scatter / force,
             all.outcrops.mean(), outcrop.scatter);
  std::fflush(stdout);
}

}  // namespace

/// Optional arguments: throw over depth (0.03), grains (100), residual (1e-3), seeds (10).
int main(int argc, char** argv) {
  auto const argument = [&](int k, double otherwise) { return argc > k ? std::atof(argv[k]) : otherwise; };
  auto choice = fault_benchmarks::small_free_field(argc, argv);
  double const tolerance = argument(3, 1e-3);
  int const seeds = std::max(2, static_cast<int>(argument(4, 10.0)));
  using Usual = Setting<QuasiNewton<PointSecant>>;
  using Along = Setting<QuasiNewton<PointSecant, PlainStep, SparseLu, AlongIterates>>;
  Usual const tight{.name = "a fifth of the residual, half the steps",
                    .most_iterations = 60,
                    .largest_gradient = 0.005,
                    .residual = 0.2};
  auto const settings = std::make_tuple(
      Usual{"point secant"}, Usual{.name = "point secant, three times the residual", .residual = 3.0},
      Usual{.name = "point secant, ten times the residual", .residual = 10.0},
      Usual{.name = "point secant, half the steps", .largest_gradient = 0.005},
      Usual{
          .name = "point secant, three times the residual, half the steps", .largest_gradient = 0.005, .residual = 3.0},
      Along{.name = "point secant along iterates", .few = 12, .many = 20, .most_iterations = 60},
      Along{.name = "along iterates, half the steps",
            .few = 12,
            .many = 20,
            .most_iterations = 60,
            .largest_gradient = 0.005},
      Setting<scarp::DynamicRelaxation<>>{
          .name = "dynamic relaxation", .least_steps = 4, .few = 150, .many = 300, .most_iterations = 1000});
  fmt::print(
      "| solver | unfinished | iterations of a step | CPU s | surface, mean off [% of throw] (its standard error) | "
      "scatter of seeds | reactions, mean off [%] (its standard error) | scatter of seeds | outcrop [m] |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  Ensemble const reference = ensemble(tight, choice, tolerance, seeds);
  print_row(tight.name, reference, reference);
  std::apply(
      [&](auto const&... setting) {
        (print_row(setting.name, ensemble(setting, choice, tolerance, seeds), reference), ...);
      },
      settings);
}

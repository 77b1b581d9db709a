// SPDX-License-Identifier: BSL-1.0
// Where does the time of the free-field fault scene go? Points by depth, strain and what sets their number of DEM steps, iterations by
// cause, and everything outside of the points; Markdown on stdout.
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

#include "../../examples/shared/study/typed_scenes.hpp"
#include "profiled.hpp"
#include "scarp/measure/cpu_time.hpp"
#include "scarp/measure/processor.hpp"
#include "scarp/observe/ground_at_rest.hpp"
#include "scarp/observe/rupture_survey.hpp"
#include "scarp/scene/nonlocal_scene.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace {

using profile::Reason;
using profile::Tallies;
using profile::Tally;

struct ProfiledPackings : profile::Profiled<scarp::DemRve<fault_rupture::Grains, fault_rupture::Columns>> {};
struct ProfiledSand : scarp::StiffnessFloor<ProfiledPackings> {};
using Scene = scarp::FreeFieldFault<scarp::Nonlocal<ProfiledSand>>;

/// Iterations by what they were for, and the progress of a long run.
struct Iterations : scarp::NeverStops {
  double depth = 25.0;  ///< of the layer [m]
  long first = 0;       ///< answers to a prediction
  long further = 0;
  long refused = 0;  ///< of attempts that were rolled back
  int most = 0;      ///< of one accepted step

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const& report) {
    if (!report.verdict.acceptable()) {
      refused += report.iterations();
      return;
    }
    ++first;
    further += report.iterations() - 1;
    most = std::max(most, report.iterations());
    fmt::print(stderr, "h/H {:.5f}  iterations {}  {:.1f} s\n", report.load / depth, report.iterations(),
               report.seconds);
  }
};

double seconds_of(Tally const& tally) { return 1e-9 * static_cast<double>(tally.nanoseconds.load()); }

std::string share(double part, double whole) { return fmt::format("{:.1f} %", 100.0 * part / whole); }

/// Wall time [s] of a call, the mean of several.
template <class Call>
double timed(Call const& call) {
  constexpr int calls = 5;
  auto const start = std::chrono::steady_clock::now();
  for (int k = 0; k < calls; ++k) call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / calls;
}

/// What one iteration does beside the points' answers, each timed alone in the last state.
template <class Problem>
std::string parts_of_an_iteration(Problem& problem) {
  using Stiffness = typename Problem::GroundStiffness;
  Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem.dof_count());
  auto const tangents = problem.committed_tangents();
  scarp::FreeSystem const system(problem.constraints());
  Stiffness stiffness;
  scarp::detail::GroundEquations<Stiffness, scarp::SparseLu> equations;
  double const assembly = timed([&] { problem.ground_stiffness(still, tangents, stiffness); });
  double const factors = timed([&] { equations.factorize(system, stiffness); });
  Eigen::VectorXd const force = equations.product(Eigen::VectorXd::Random(system.free_count()));
  double const solution = timed([&] { equations.solve(force); });
  auto gradients = problem.own_gradients();
  double const means = timed([&] { problem.materials().mean().means(gradients, problem.executor()); });
  double const forces = timed([&] { problem.evaluate_committed(); });
  double const tangent = timed([&] { problem.committed_tangents(); });
  return fmt::format(
      "| assembly | factors of the local part | GMRES | means of all gradients | sum of forces | all points' tangents "
      "|\n"
      "| --- | --- | --- | --- | --- | --- |\n| {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.2f} | {:.1f} |\n",
      1e3 * assembly, 1e3 * factors, 1e3 * solution, 1e3 * means, 1e3 * forces, 1e3 * tangent);
}

std::string by_place(Tallies const& tallies, double all) {
  std::string text =
      "| depth [m] | strain below 0.5 %: answers, DEM steps each, share | 0.5 to 5 % | beyond 5 % | share |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (int k = 0; k < Tallies::depths; ++k) {
    double sum = 0.0;
    text +=
        fmt::format("| {:g} to {:g} |", tallies.depth * k / Tallies::depths, tallies.depth * (k + 1) / Tallies::depths);
    for (auto const& row : tallies.by_place) {
      auto const& tally = row[static_cast<std::size_t>(k)];
      double const calls = static_cast<double>(tally.calls.load());
      text += calls == 0.0
                  ? " none |"
                  : fmt::format(" {:.0f}, {:.0f}, {} |", calls, static_cast<double>(tally.dem_steps.load()) / calls,
                                share(seconds_of(tally), all));
      sum += seconds_of(tally);
    }
    text += fmt::format(" {} |\n", share(sum, all));
  }
  return text;
}

std::string by_reason(Tallies const& tallies, double all, double steps) {
  std::string text =
      "| number of DEM steps set by | answers | DEM steps each | share of the DEM steps | of the time |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (std::size_t k = 0; k < tallies.by_reason.size(); ++k) {
    auto const& tally = tallies.by_reason[k];
    double const own = static_cast<double>(tally.dem_steps.load());
    double const calls = static_cast<double>(tally.calls.load());
    text += fmt::format("| {} | {:.0f} | {:.0f} | {} | {} |\n", profile::reason_names[k], calls,
                        own / std::max(calls, 1.0), share(own, steps), share(seconds_of(tally), all));
  }
  return text;
}

struct Options {
  fault_rupture::Choice choice;
  double tolerance = 1e-3;
};

Options read(int argc, char** argv) {
  Options options;
  auto& choice = options.choice;
  choice.length = 8.0;
  choice.packings = 16;
  choice.mirrored_packings = true;
  choice.strain_per_step = 2e-5;
  choice.unbalanced_tolerance = 0.1;
  choice.threads = 1;
  CLI::App app("Where does the time of the free-field fault scene go? Markdown on stdout.");
  app.option_defaults()->always_capture_default();
  app.add_option("--size", choice.size, "width of a mesh cell in the band [m]")->check(CLI::Range(0.5, 25.0));
  app.add_option("--triangles", choice.triangles, "wanted number of elements instead of --size")
      ->check(CLI::Range(100, 1'000'000))
      ->excludes("--size");
  app.add_option("--length", choice.length, "intrinsic length [m]")->check(CLI::Range(0.1, 100.0));
  app.add_option("--grains", choice.grains, "grains in each RVE")->check(CLI::Range(9, 100'000));
  app.add_option("--throw-over-depth", choice.throw_over_depth, "h/H at the end")->check(CLI::Range(1e-5, 0.5));
  app.add_option("--tolerance", options.tolerance, "force residual over reactions")->check(CLI::Range(1e-9, 1.0));
  app.add_option("--seed", choice.seed, "of the packings");
  app.add_option("--threads", choice.threads, "0 takes all processors")->check(CLI::Range(0, 1024));
  try {
    app.parse(argc, argv);
  } catch (CLI::ParseError const& problem) {
    std::exit(app.exit(problem) == 0 ? 0 : 2);
  }
  return options;
}

void profile_scene(Options const& options) {
  auto const& choice = options.choice;
  scarp::CpuTime const preparing;
  auto const study = fault_rupture::make<fault_rupture::SandFreeField>(choice);
  double const preparation = preparing.seconds();
  Scene scene;
  auto& sand = scene.soil.provider;
  sand.provider.provider = study.soil.provider;
  scene.soil.length = choice.length;
  scene.ground.layer = study.ground.layer;
  scene.fault = study.fault;
  scene.throw_to = study.throw_to;
  scene.stepping = study.stepping;
  scene.solver.tolerance = options.tolerance;
  scene.solver.most_iterations = choice.most_iterations;
  auto const tallies = sand.provider.tallies;
  tallies->depth = study.ground.layer.depth;

  scarp::ThreadExecutor executor(choice.threads);
  auto problem = scene.problem(executor);
  Iterations iterations;
  iterations.depth = tallies->depth;
  scarp::CpuTime const running;
  auto report = scene.settle(problem, iterations);
  auto const rest = scarp::ground_at_rest(problem);
  if (report.verdict.acceptable()) report = scarp::joined(report, scene.rupture(problem, iterations));
  double const cpu = running.seconds();
  rusage used{};
  getrusage(RUSAGE_SELF, &used);

  double answers = 0.0;
  for (auto const& tally : tallies->by_reason) answers += seconds_of(tally);
  double const tangents = seconds_of(tallies->tangents);
  double const steps = static_cast<double>(report.inner_steps);
  auto const& mesh = problem.discretisation().mesh();
  auto const profile = scarp::surface_profile(mesh, rest.of(mesh), problem.discretisation().positions());
  auto const survey = scarp::rupture_survey(mesh, rest.of(mesh), problem.discretisation().positions(),
                                            offset_at(scene.fault, report.load));

  fmt::print("{} triangles of {} grains, length {:g} m, h/H {:.4f}, residual {:g}, {} threads, {}; {}\n\n",
             mesh.elements.size(), choice.grains, choice.length, report.load / tallies->depth, options.tolerance,
             executor.threads(), scarp::processor(), report.verdict.acceptable() ? "ok" : name(report.verdict.reason));
  fmt::print(
      "| preparation, CPU s | run, CPU s | run, wall s | DEM steps, million | us per DEM step, all of the run | memory "
      "[MB] | x50 [m] |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n| {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.1f} | {:.0f} | {:.2f} "
      "|\n\n",
      preparation, cpu, report.seconds, 1e-6 * steps, 1e6 * cpu / steps,
      1e-3 * 1.024 * static_cast<double>(used.ru_maxrss), survey.surface.surface_x50);
  fmt::print("| packings' answers | their tangents | all else |\n| --- | --- | --- |\n| {} | {} | {} |\n\n",
             share(answers, cpu), share(tangents, cpu), share(cpu - answers - tangents, cpu));
  fmt::print("{}\n{}\n", by_place(*tallies, answers), by_reason(*tallies, answers, steps));
  fmt::print(
      "| accepted steps | refused attempts | first iterations | further ones | of refused attempts | most of one step "
      "| answers that are fluid | not converged |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n| {} | {} | {} | {} | {} | {} | {} | {} |\n\n",
      report.steps, report.refused, iterations.first, iterations.further, iterations.refused, iterations.most,
      tallies->by_status[static_cast<std::size_t>(scarp::Status::fluid)].calls.load(),
      tallies->by_status[static_cast<std::size_t>(scarp::Status::not_converged)].calls.load());
  fmt::print("Milliseconds of wall time, each alone in the last state:\n\n{}", parts_of_an_iteration(problem));
}

}  // namespace

int main(int argc, char** argv) {
  auto const options = read(argc, argv);
  try {
    profile_scene(options);
  } catch (std::exception const& problem) {
    fmt::print(stderr, "profile: {}\n", problem.what());
    return 1;
  }
}

// SPDX-License-Identifier: BSL-1.0
// Where does the time of the free-field fault scene go? Points by depth, strain and what sets their number of DEM
// steps, iterations by cause, and everything outside of the points.
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <string>

#include "../shared/data_file.hpp"
#include "../shared/nonlocal_fault.hpp"
#include "profiled.hpp"
#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/fault/rupture_survey.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/run/resources.hpp"
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
  long first = 0;       ///< responses to a prediction
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

/// Part of the run, measure with its unit, value.
using Table = scarp::CsvTable;

/// Wall time [s] of a call, the mean of several.
template <class Call>
double timed(Call const& call) {
  constexpr int calls = 5;
  auto const start = std::chrono::steady_clock::now();
  for (int k = 0; k < calls; ++k) call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / calls;
}

/// The parts of an iteration other than the points' responses, each timed alone in the last state.
template <class Problem>
void add_parts_of_an_iteration(Problem& problem, Table& table) {
  Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem.dof_count());
  auto const tangents = problem.committed_tangents();
  scarp::LinearSystem system(problem.constraints());
  scarp::GroundStiffness stiffness;
  auto const add = [&](char const* what, auto const& call) {
    table.add("one iteration, last state", fmt::format("{}, wall time [ms]", what), 1e3 * timed(call));
  };
  add("assembly", [&] { problem.ground_stiffness(still, tangents, stiffness); });
  add("factors of the local part", [&] { static_cast<void>(system.factorize(stiffness)); });
  Eigen::VectorXd const force = system.product(Eigen::VectorXd::Random(system.free_count()));
  add("GMRES", [&] { system.solve(force); });
  auto gradients = problem.own_gradients();
  auto const* means = problem.points().means();
  if (means)
    add("means of all gradients",
        [&] { means->mean().means(gradients, std::vector(gradients.size(), 1.0), problem.executor()); });
  add("sum of forces", [&] { static_cast<void>(problem.evaluate_committed()); });
  add("tangents of all points", [&] { problem.committed_tangents(); });
}

void add_tally(Table& table, std::string const& part, Tally const& tally, double all) {
  double const calls = static_cast<double>(tally.calls.load());
  table.add(part, "responses", calls);
  table.add(part, "DEM steps each", static_cast<double>(tally.dem_steps.load()) / std::max(calls, 1.0));
  table.add(part, "share of the responses' CPU time", seconds_of(tally) / all);
}

void add_tallies(Tallies const& tallies, double all, Table& table) {
  constexpr std::array strains{"below 0.5 %", "0.5 to 5 %", "beyond 5 %"};
  for (std::size_t row = 0; row < strains.size(); ++row) {
    for (int k = 0; k < Tallies::depths; ++k) {
      add_tally(table,
                fmt::format("depth {:g} to {:g} m, strain {}", tallies.depth * k / Tallies::depths,
                            tallies.depth * (k + 1) / Tallies::depths, strains[row]),
                tallies.by_place[row][static_cast<std::size_t>(k)], all);
    }
  }
  for (std::size_t k = 0; k < tallies.by_reason.size(); ++k)
    add_tally(table, fmt::format("DEM steps set by {}", profile::reason_names[k]), tallies.by_reason[k], all);
}

void profile_scene(bool quick) {
  auto const choice = benchmarks::nonlocal_fault(quick ? 2 : 16, quick);
  scarp::CpuTime const preparing;
  auto const study = fault_rupture::make_sand_free_field(choice);
  double const preparation = preparing.seconds();
  auto scene = benchmarks::without_provider<Scene>(choice, study);
  auto& sand = scene.soil.provider;
  sand.provider.provider = study.soil.provider;
  auto const tallies = sand.provider.tallies;
  tallies->depth = study.ground.layer.depth;

  scarp::ThreadExecutor executor(1);
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

  double responses = 0.0;
  for (auto const& tally : tallies->by_reason) responses += seconds_of(tally);
  double const tangents = seconds_of(tallies->tangents);
  double const steps = static_cast<double>(report.inner_steps);
  auto const& mesh = problem.discretisation().mesh();
  auto const survey = scarp::rupture_survey(mesh, rest.of(mesh.nodes), problem.discretisation().positions(),
                                            offset_at(scene.fault, report.load));
  Table table({"part", "measure", "value"});
  auto const add = [&](char const* what, double value) { table.add("run", what, value); };
  add("CPU time [s]", cpu);
  add("CPU time of the preparation [s]", preparation);
  add("DEM steps [million]", 1e-6 * steps);
  add("CPU time per DEM step [us]", 1e6 * cpu / steps);
  add("share of the packings' responses", responses / cpu);
  add("share of their tangents", tangents / cpu);
  add("share of all else", 1.0 - (responses + tangents) / cpu);
  add("accepted steps", report.steps);
  add("rejected attempts", report.refused);
  add("first iterations", static_cast<double>(iterations.first));
  add("further iterations", static_cast<double>(iterations.further));
  add("x50 [m]", survey.surface.surface_x50);
  add("triangles", static_cast<double>(mesh.elements.size()));
  add("h/H", report.load / tallies->depth);
  add("wall time [s]", report.seconds);
  add("memory [MB]", 1e-3 * 1.024 * static_cast<double>(used.ru_maxrss));
  add("iterations of rejected attempts", static_cast<double>(iterations.refused));
  add("most iterations of one step", iterations.most);
  for (auto const status : {scarp::Status::fluid, scarp::Status::not_converged}) {
    table.add("run", fmt::format("responses {}", name(status)),
              static_cast<double>(tallies->by_status[static_cast<std::size_t>(status)].calls.load()));
  }
  table.add("run", "status", report.verdict.acceptable() ? "ok" : name(report.verdict.reason));
  add_tallies(*tallies, responses, table);
  add_parts_of_an_iteration(problem, table);
  benchmarks::write_data("profile", table.text());
}

}  // namespace

/// --quick: 220 triangles with 60 grains each
int main(int argc, char** argv) try {
  profile_scene(benchmarks::is_quick(argc, argv));
  return 0;
} catch (std::exception const& problem) {
  fmt::print(stderr, "profile: {}\n", problem.what());
  return 1;
}

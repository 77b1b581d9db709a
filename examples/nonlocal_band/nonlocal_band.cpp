// SPDX-License-Identifier: BSL-1.0
// Does the width of a shear band in softening soil depend on the mesh, and what does an intrinsic length change?
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <filesystem>

#include "../shared/command_line.hpp"
#include "../shared/print.hpp"
#include "../shared/run_options.hpp"
#include "../shared/version_option.hpp"
#include "band.hpp"
#include "fault.hpp"
#include "scarp/io/csv.hpp"

namespace {

using namespace nonlocal_band;

struct Choice {
  std::vector<int> cells{6, 9, 12};
  std::vector<double> lengths{0.0, 0.25};
  scarp::Neighbourhood neighbourhood{};  ///< but for its length
  double from = 0.02;
  double to = 0.04;
  double step = 5e-4;
  double tolerance = 1e-6;
  int max_iterations = 30;
  double gate = 0.0;
  scarp::RunFolder* folder = nullptr;  ///< of the results, if they are wanted
};

/// What a run on one mesh ends with.
struct Outcome {
  Band band{};
  double pressure = 0.0;  ///< mean on the top [Pa]
};

/// Load and settlement of the top, and where the nodes were when the measurement of the band begins.
struct Record {
  double from;
  std::vector<std::array<double, 3>> curve{};  ///< settlement [m], mean pressure on the top [Pa], share of tau
  std::vector<scarp::Vector<2>> start{};

  void attempted(Problem const& problem, scarp::StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    auto const [force, share] = top_force(problem);
    curve.push_back({report.load, force / width, share});
    if (start.empty() && report.load >= from) start = problem.discretisation().positions();
  }
  bool wants_stop() const { return false; }
};

void write(Choice const& choice, Problem const& problem, Record const& record, std::vector<double> const& shears,
           std::string const& name) {
  std::filesystem::path const& folder = choice.folder->path();
  choice.folder->begin();
  scarp::CsvTable curve({"settlement [m]", "pressure [Pa]", "share of tau"});
  for (auto const& row : record.curve) curve.add(row[0], row[1], row[2]);
  curve.write(folder / ("load_" + name + ".csv"));
  scarp::CsvTable points({"x [m]", "y [m]", "shear strain"});
  for (std::size_t k = 0; k < shears.size(); ++k) {
    auto const place = problem.discretisation().site(static_cast<int>(k), height).position;
    points.add(place.x(), place.y(), shears[k]);
  }
  points.write(folder / ("shear_" + name + ".csv"));
}

Outcome print_row(Choice const& choice, int cells, double length) {
  examples::Stopwatch const watch;
  scarp::ThreadExecutor executor(1);
  auto neighbourhood = choice.neighbourhood;
  neighbourhood.length = length;
  Problem problem = specimen(cells, neighbourhood, executor);
  Record record{.from = choice.from};
  examples::Newton const newton{.tolerance = choice.tolerance, .max_iterations = choice.max_iterations};
  scarp::LoadStepping const stepping{
      .first = choice.step, .smallest = 1e-3 * choice.step, .largest = choice.step, .max_displacement_gradient = 1.0};
  auto const run = stepping.run(newton, problem, 0.0, choice.to, record);
  double peak = 0.0;
  for (auto const& row : record.curve) peak = std::max(peak, row[1]);
  double const none = std::nan("");
  auto const last = record.curve.empty() ? std::array{0.0, none, none} : record.curve.back();
  Outcome outcome{{}, last[1]};
  if (!record.start.empty()) {
    auto const shears = shear_strains(problem, record.start, problem.discretisation().positions());
    outcome.band = measure(problem, shears);
    if (choice.folder != nullptr) write(choice, problem, record, shears, fmt::format("{}_{}", cells, length));
  }
  examples::print(
      stdout, "{:6} {:6} {:8.4f} {:9.2f} {:9.2f} {:8.4f} {:8.4f} {:7.2f} {:9.1e} {:6} {:8} {:6} {:8.1f}  {}\n", cells,
      length, last[0], peak / 1e3, last[1] / 1e3, outcome.band.width, outcome.band.spread, outcome.band.angle, last[2],
      run.steps, run.refused, run.iterations, watch.seconds(), run.verdict.acceptable() ? "" : name(run.last_failure));
  std::fflush(stdout);
  if (!run.verdict.acceptable()) outcome.band.width = std::nan("");
  return outcome;
}

/// Whether widths and last pressures of all meshes with a length agree within a part of the first.
bool print_specimens(Choice const& choice) {
  examples::print(stdout, "{:>6} {:>6} {:>8} {:>9} {:>9} {:>8} {:>8} {:>7} {:>9} {:>6} {:>8} {:>6} {:>8}\n", "cells",
                  "l [m]", "end [m]", "most kPa", "last kPa", "width", "spread", "angle", "tau", "steps", "rejected",
                  "iter", "s");
  bool good = true;
  for (double const length : choice.lengths) {
    std::vector<Outcome> outcomes;
    for (int const cells : choice.cells) outcomes.push_back(print_row(choice, cells, length));
    if (length == 0.0 || choice.gate == 0.0) continue;
    for (auto const& outcome : outcomes) {
      good &= std::abs(outcome.band.width / outcomes.front().band.width - 1.0) <= choice.gate;
      good &= std::abs(outcome.pressure / outcomes.front().pressure - 1.0) <= choice.gate;
    }
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  Choice choice;
  CLI::App app{"Shear band in a biaxial specimen of softening soil against mesh and intrinsic length"};
  examples::declare_version(app);
  app.option_defaults()->always_capture_default();
  using examples::number_from;
  auto const positive = number_from(0.0, false, 1e3);
  auto const length = number_from(0.0, true, 1e3);
  auto const share = number_from(0.0, true, 1.0);
  app.add_option("--cells", choice.cells, "across the width, one number for each mesh")
      ->delimiter(',')
      ->check(CLI::Range(1, 1000));
  app.add_option("--lengths", choice.lengths, "intrinsic lengths [m]")->delimiter(',')->check(length);
  app.add_option("--stiffness", choice.neighbourhood.stiffness, "against fluctuation strain, share of the initial one")
      ->check(share);
  app.add_option("--fading", choice.neighbourhood.fading, "strain after which the stress of that stiffness has faded")
      ->check(positive);
  app.add_option("--from", choice.from, "settlement from which the band is measured [m]")->check(length);
  app.add_option("--to", choice.to, "settlement at the end [m]")->check(positive);
  app.add_option("--step", choice.step, "largest settlement of a load step [m]")->check(positive);
  app.add_option("--tolerance", choice.tolerance, "of the force residual")->check(number_from(0.0, false, 1.0));
  app.add_option("--max-iterations", choice.max_iterations, "of a load step")->check(CLI::Range(1, 10'000));
  app.add_option("--max-error", choice.gate, "largest difference between meshes with a length, as a part; 0 for none")
      ->check(length);
  examples::Output output;
  examples::declare_output(app, output, "folder for load curves and shear strains");
  FaultChoice fault;
  auto* const rupture = app.add_subcommand("fault", "fault rupture through level ground of Mohr-Coulomb soil instead");
  rupture->add_option("--sizes", fault.sizes, "of a mesh cell in the band [m]")
      ->delimiter(',')
      ->check(number_from(0.0, false, 25.0));
  rupture->add_option("--lengths", fault.lengths, "intrinsic lengths [m]")->delimiter(',')->check(length);
  rupture->add_option("--stiffness", fault.stiffness, "as above")->check(share);
  rupture->add_option("--fading", fault.fading, "as above")->check(positive);
  rupture->add_option("--throw-over-depth", fault.throw_over_depth, "at the end")->check(number_from(0.0, false, 1.0));
  rupture->add_option("--tolerance", fault.tolerance, "of the force residual")->check(number_from(0.0, false, 1.0));
  if (auto const code = examples::ended_by_options(app, argc, argv)) return *code;
  try {
    if (rupture->parsed()) {
      print_fault(fault);
      return 0;
    }
    if (!(choice.from < choice.to))
      scarp::reject("--from is {} m (the settlement ends at {} m): choose a smaller one", choice.from, choice.to);
    std::optional<scarp::RunFolder> folder;
    if (!output.folder.empty()) {
      folder.emplace(scarp::RunFolderSettings{.folder = output.folder, .overwrite = output.overwrite},
                     examples::record_of("nonlocal_band", app));
      choice.folder = &*folder;
    }
    bool const good = print_specimens(choice);
    if (folder) folder->end("finished");
    if (good) return 0;
    examples::print(stderr, "nonlocal_band: meshes with a length differ by more than {:g}\n", choice.gate);
  } catch (std::exception const& error) {
    return examples::ended_by(error, "nonlocal_band", app);
  }
  return 1;
}
